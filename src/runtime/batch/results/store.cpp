// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/store.hpp"

#include <sqlite3.h>

#include <sstream>
#include <utility>

#include "orca/base/files/open_output.hpp"
#include "orca/base/hash.hpp"
#include "orca/base/text.hpp"

namespace orca::batch {
namespace {

constexpr const char* kSchema = R"(
  PRAGMA journal_mode = WAL;
  PRAGMA synchronous = NORMAL;
  CREATE TABLE IF NOT EXISTS experiment (identity TEXT NOT NULL, file TEXT NOT NULL, plugins TEXT NOT NULL);
  CREATE TABLE IF NOT EXISTS runs (
    variant TEXT NOT NULL, world TEXT NOT NULL, seed TEXT NOT NULL, ending TEXT NOT NULL, reason TEXT NOT NULL,
    time REAL NOT NULL, goals INTEGER NOT NULL, failed_goals INTEGER NOT NULL, contacts INTEGER NOT NULL,
    failure TEXT NOT NULL, trace_hash TEXT NOT NULL,@
    PRIMARY KEY (variant, world, seed)) WITHOUT ROWID;
  CREATE TABLE IF NOT EXISTS tracks (
    variant TEXT NOT NULL, world TEXT NOT NULL, seed TEXT NOT NULL, places TEXT NOT NULL, contacts TEXT NOT NULL,
    map TEXT NOT NULL, PRIMARY KEY (variant, world, seed)) WITHOUT ROWID;
  CREATE TABLE IF NOT EXISTS maps (hash TEXT PRIMARY KEY, walls TEXT NOT NULL) WITHOUT ROWID;
  CREATE TABLE IF NOT EXISTS timing (
    variant TEXT NOT NULL, world TEXT NOT NULL, seed TEXT NOT NULL, wall REAL NOT NULL, cpu REAL NOT NULL,
    laps TEXT NOT NULL, PRIMARY KEY (variant, world, seed)) WITHOUT ROWID;
  CREATE TABLE IF NOT EXISTS repeats (
    variant TEXT NOT NULL, world TEXT NOT NULL, seed TEXT NOT NULL,
    first TEXT NOT NULL, second TEXT NOT NULL, difference TEXT NOT NULL,
    PRIMARY KEY (variant, world, seed)) WITHOUT ROWID;
  CREATE TABLE IF NOT EXISTS inputs (name TEXT PRIMARY KEY NOT NULL, content TEXT NOT NULL) WITHOUT ROWID;
  CREATE TABLE IF NOT EXISTS declarations (
    what TEXT NOT NULL, text TEXT NOT NULL, date TEXT NOT NULL, UNIQUE (what, text));
)";

constexpr const char* kBetweenFolders = "\n";
constexpr const char* kLate = ", after the first runs";

// Changes with each change of the tables.
constexpr std::uint32_t kLayout = 5;

// Returns the schema, with a column for each measure.
std::string schema() {
  std::string columns;
  for (const Measure& measure : all_measures())
    columns += (columns.empty() ? " " : ", ") + std::string(measure.name) + " REAL";
  std::string text = kSchema;
  text.replace(text.find('@'), 1, columns + ",");
  return text + "PRAGMA user_version = " + std::to_string(kLayout) + ";";
}

// Returns "?, ?, ?".
std::string marks(std::size_t count) {
  std::string text = "?";
  for (std::size_t i = 1; i < count; ++i) text += ", ?";
  return text;
}

struct Close {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Database = std::unique_ptr<sqlite3, Close>;

// A statement, with its values in the order of their marks.
class Statement {
 public:
  Statement(sqlite3* database, const std::string& text) {
    sqlite3_stmt* made = nullptr;
    (void)sqlite3_prepare_v2(database, text.c_str(), -1, &made, nullptr);
    statement_.reset(made);  // null if there was an error, which the steps will report
  }

  Statement& operator<<(const std::string& value) {
    (void)sqlite3_bind_text(statement_.get(), ++bound_, value.c_str(), static_cast<int>(value.size()),
                            SQLITE_TRANSIENT);
    return *this;
  }
  Statement& operator<<(double value) {
    (void)sqlite3_bind_double(statement_.get(), ++bound_, value);
    return *this;
  }
  Statement& operator<<(const std::optional<double>& value) {
    if (value) return *this << *value;
    (void)sqlite3_bind_null(statement_.get(), ++bound_);
    return *this;
  }
  Statement& operator<<(std::uint32_t value) {
    (void)sqlite3_bind_int64(statement_.get(), ++bound_, value);
    return *this;
  }

  // Returns SQLITE_ROW, SQLITE_DONE or an error.
  int step() { return sqlite3_step(statement_.get()); }

  [[nodiscard]] std::string text(int column) const {
    const auto* const bytes = sqlite3_column_text(statement_.get(), column);
    return bytes == nullptr ? "" : reinterpret_cast<const char*>(bytes);
  }
  [[nodiscard]] double number(int column) const { return sqlite3_column_double(statement_.get(), column); }
  [[nodiscard]] std::optional<double> number_if_any(int column) const {
    if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) return std::nullopt;
    return number(column);
  }
  [[nodiscard]] std::uint32_t count(int column) const {
    return static_cast<std::uint32_t>(sqlite3_column_int64(statement_.get(), column));
  }

 private:
  std::unique_ptr<sqlite3_stmt, Close> statement_;
  int bound_ = 0;
};

// Seeds are text: 64 bits without a sign do not fit SQLite's numbers. Padded, their order is that of the numbers.
std::string padded(std::uint64_t seed) {
  constexpr std::size_t kDigits = 20;
  const std::string digits = std::to_string(seed);
  return std::string(kDigits - digits.size(), '0') + digits;
}

// Most runs of a world leave the same map, which is kept once.
std::string hash_of(const std::string& walls) {
  Fnv1a hash;
  hash.add_text(walls);
  return padded(hash.value());
}

class SqliteStore final : public Store {
 public:
  SqliteStore(std::string file, Database database) : file_(std::move(file)), database_(std::move(database)) {}

  Status prepare(const std::string& identity, const Origin& origin) {
    if (Status known = check_layout(); !known.ok()) return known;
    if (sqlite3_exec(database_.get(), schema().c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
      return fault();
    if (identity.empty()) return ok();
    if (const std::string known = this->identity(); !known.empty()) return check(known, identity);
    Statement note(database_.get(), "INSERT INTO experiment VALUES (?, ?, ?)");
    note << identity << origin.file << joined(origin.plugins, kBetweenFolders);
    return note.step() == SQLITE_DONE ? ok() : fault();
  }

  Status add(const Row& row) override {
    const std::string seed = padded(row.seed);
    return in_transaction([&] { return add_parts(row, seed); });
  }

  [[nodiscard]] bool has(const std::string& variant, const std::string& world,
                         std::uint64_t seed) const override {
    Statement found(database_.get(), "SELECT 1 FROM runs WHERE variant = ? AND world = ? AND seed = ?");
    return (found << variant << world << padded(seed)).step() == SQLITE_ROW;
  }

  [[nodiscard]] std::optional<Row> find(const std::string& variant, const std::string& world,
                                        std::uint64_t seed) const override {
    Statement found(database_.get(),
                    "SELECT * FROM runs JOIN timing USING (variant, world, seed) "
                    "WHERE variant = ? AND world = ? AND seed = ?");
    if ((found << variant << world << padded(seed)).step() != SQLITE_ROW) return std::nullopt;
    return row_of(found);
  }

  [[nodiscard]] Sketch sketch(const std::string& variant, const std::string& world,
                              std::uint64_t seed) const override {
    Statement found(database_.get(),
                    "SELECT places, contacts, walls FROM tracks JOIN maps ON map = hash "
                    "WHERE variant = ? AND world = ? AND seed = ?");
    if ((found << variant << world << padded(seed)).step() != SQLITE_ROW) return {};
    return {found.text(0), found.text(1), found.text(2)};
  }

  Status for_each(const std::function<void(const Row&)>& take) const override {
    Statement all(
        database_.get(),
        "SELECT * FROM runs JOIN timing USING (variant, world, seed) ORDER BY variant, world, seed");
    int found = SQLITE_ROW;
    while ((found = all.step()) == SQLITE_ROW) take(row_of(all));
    return found == SQLITE_DONE ? ok() : fault();
  }

  Status add(const RepeatRow& row) override {
    Statement note(database_.get(), "INSERT OR IGNORE INTO repeats VALUES (?, ?, ?, ?, ?, ?)");
    note << row.variant << row.world << padded(row.seed) << row.repeat.first << row.repeat.second
         << row.repeat.difference;
    return note.step() == SQLITE_DONE ? ok() : fault();
  }

  [[nodiscard]] std::vector<RepeatRow> repeats() const override {
    Statement all(database_.get(), "SELECT * FROM repeats ORDER BY variant, world, seed");
    std::vector<RepeatRow> rows;
    while (all.step() == SQLITE_ROW)
      rows.push_back(
          {all.text(0), all.text(1), std::stoull(all.text(2)), {all.text(3), all.text(4), all.text(5)}});
    return rows;
  }

  Status keep(const Inputs& inputs) override {
    if (Status same = check(inputs); !same.ok()) return same;
    return in_transaction([&] {
      for (const auto& [name, content] : inputs) {
        Statement note(database_.get(), "INSERT OR IGNORE INTO inputs VALUES (?, ?)");
        if ((note << name << content).step() != SQLITE_DONE) return fault();
      }
      return ok();
    });
  }

  [[nodiscard]] Inputs inputs() const override {
    Statement all(database_.get(), "SELECT name, content FROM inputs");
    Inputs inputs;
    while (all.step() == SQLITE_ROW) inputs[all.text(0)] = all.text(1);
    return inputs;
  }

  Status declare(const std::vector<Declaration>& declarations) override {
    Statement runs(database_.get(), "SELECT 1 FROM runs");
    const bool is_late = this->declarations().empty() && runs.step() == SQLITE_ROW;
    return in_transaction([&] {
      for (const auto& [what, text, date] : declarations) {
        Statement note(database_.get(), "INSERT OR IGNORE INTO declarations VALUES (?, ?, ?)");
        if ((note << what << text << date + (is_late ? kLate : "")).step() != SQLITE_DONE) return fault();
      }
      return ok();
    });
  }

  [[nodiscard]] std::vector<Declaration> declarations() const override {
    Statement all(database_.get(), "SELECT what, text, date FROM declarations ORDER BY date, rowid");
    std::vector<Declaration> declarations;
    while (all.step() == SQLITE_ROW) declarations.push_back({all.text(0), all.text(1), all.text(2)});
    return declarations;
  }

  Status take_over(const std::string& other) override {
    const Result<std::unique_ptr<Store>> store = Store::open(other, identity());
    if (!store) return store.error();
    if (Status same = check((*store)->inputs()); !same.ok())
      return fail(same.error().code, other + ": " + same.error().message);
    Statement attach(database_.get(), "ATTACH ? AS other");
    if ((attach << other).step() != SQLITE_DONE) return fault();
    const Status taken = in_transaction([&] { return take_attached(other); });
    Statement detach(database_.get(), "DETACH other");
    return detach.step() == SQLITE_DONE || !taken.ok() ? taken : fault();
  }

  [[nodiscard]] std::string identity() const override {
    Statement known(database_.get(), "SELECT identity FROM experiment");
    return known.step() == SQLITE_ROW ? known.text(0) : "";
  }

  [[nodiscard]] Origin origin() const override {
    Statement known(database_.get(), "SELECT file, plugins FROM experiment");
    if (known.step() != SQLITE_ROW) return {};
    Origin origin{known.text(0), {}};
    std::istringstream folders(known.text(1));
    for (std::string folder; std::getline(folders, folder, kBetweenFolders[0]);)
      origin.plugins.push_back(folder);
    return origin;
  }

 private:
  [[nodiscard]] Status fault() const {
    return fail(Code::unavailable, file_ + ": " + sqlite3_errmsg(database_.get()));
  }

  Status add_parts(const Row& row, const std::string& seed) {
    const Outcome& o = row.outcome;
    Statement run(database_.get(),
                  "INSERT OR IGNORE INTO runs VALUES (" +
                      marks(static_cast<std::size_t>(kFirstMeasure) + all_measures().size()) + ")");
    run << row.variant << row.world << seed << std::string(name_of(o.ending)) << o.reason << o.time << o.goals
        << o.failed_goals << o.contacts << std::string(name_of(o.failure)) << o.trace_hash;
    for (const Measure& measure : all_measures()) run << o.measures.*measure.value;
    Statement track(database_.get(), "INSERT OR IGNORE INTO tracks VALUES (?, ?, ?, ?, ?, ?)");
    const std::string map = hash_of(o.sketch.walls);
    track << row.variant << row.world << seed << o.sketch.tracks << o.sketch.contacts << map;
    Statement walls(database_.get(), "INSERT OR IGNORE INTO maps VALUES (?, ?)");
    walls << map << o.sketch.walls;
    Statement timing(database_.get(), "INSERT OR IGNORE INTO timing VALUES (?, ?, ?, ?, ?, ?)");
    timing << row.variant << row.world << seed << row.cost.wall << row.cost.cpu << laps_text(row.cost.laps);
    for (Statement* const statement : {&run, &track, &walls, &timing})
      if (statement->step() != SQLITE_DONE) return fault();
    return ok();
  }

  Status execute(const char* text) {
    return sqlite3_exec(database_.get(), text, nullptr, nullptr, nullptr) == SQLITE_OK ? ok() : fault();
  }

  // Makes all changes of `work`, or none.
  Status in_transaction(const std::function<Status()>& work) {
    if (Status begun = execute("BEGIN"); !begun.ok()) return begun;
    Status worked = work();
    if (worked.ok()) worked = execute("COMMIT");
    if (!worked.ok()) (void)execute("ROLLBACK");
    return worked;
  }

  Status take_attached(const std::string& other) {
    Statement conflict(database_.get(),
                       "SELECT * FROM other.runs WHERE (variant, world, seed) IN "
                       "(SELECT variant, world, seed FROM main.runs) EXCEPT SELECT * FROM main.runs LIMIT 1");
    const int found = conflict.step();
    if (found == SQLITE_ROW)
      return fail(Code::failed_precondition,
                  other + " has another outcome of variant " + conflict.text(0) + ", world " +
                      conflict.text(1) + ", seed " + std::to_string(std::stoull(conflict.text(2))) +
                      " than a folder before it; simbatch diff shows what differs");
    if (found != SQLITE_DONE) return fault();
    return execute(R"(
      INSERT OR IGNORE INTO main.runs SELECT * FROM other.runs;
      INSERT OR IGNORE INTO main.tracks SELECT * FROM other.tracks;
      INSERT OR IGNORE INTO main.maps SELECT * FROM other.maps;
      INSERT OR IGNORE INTO main.timing SELECT * FROM other.timing;
      INSERT OR IGNORE INTO main.repeats SELECT * FROM other.repeats;
      INSERT OR IGNORE INTO main.inputs SELECT * FROM other.inputs;
      INSERT INTO main.declarations SELECT * FROM other.declarations WHERE true ORDER BY rowid
        ON CONFLICT DO UPDATE SET date = min(date, excluded.date);)");
  }

  // Inputs that are not known yet are those of more worlds.
  [[nodiscard]] Status check(const Inputs& inputs) const {
    const Inputs known = this->inputs();
    std::vector<std::string> others;
    for (const auto& [name, content] : inputs)
      if (const auto found = known.find(name); found != known.end() && found->second != content)
        others.push_back(name);
    if (others.empty()) return ok();
    return fail(Code::failed_precondition,
                "since results were made, these were changed: " + listed(others) +
                    "; runs before and after a change cannot be compared, so make all runs again, in another "
                    "folder (--out)");
  }

  // A file of another layout would be read column by column into the wrong places.
  [[nodiscard]] Status check_layout() {
    Statement tables(database_.get(), "SELECT 1 FROM sqlite_master WHERE name = 'runs'");
    const int found = tables.step();
    if (found != SQLITE_ROW && found != SQLITE_DONE) return fault();
    Statement layout(database_.get(), "PRAGMA user_version");
    if (layout.step() != SQLITE_ROW) return fault();
    if (found == SQLITE_DONE || layout.count(0) == kLayout) return ok();
    return fail(Code::failed_precondition,
                file_ +
                    " was made by another version of simbatch, with other columns; make the runs again, in "
                    "another folder (--out)");
  }

  [[nodiscard]] Status check(const std::string& known, const std::string& identity) const {
    if (known == identity) return ok();
    return fail(Code::failed_precondition,
                file_ +
                    " holds results of another experiment, or of this one before it was changed; "
                    "choose another folder with --out");
  }

  static Row row_of(const Statement& found) {
    Row row;
    row.variant = found.text(0);
    row.world = found.text(1);
    row.seed = std::stoull(found.text(2));
    row.outcome.ending = ending_of(found.text(3)).value_or(Ending::crash);
    row.outcome.reason = found.text(4);
    row.outcome.time = found.number(5);
    row.outcome.goals = found.count(6);
    row.outcome.failed_goals = found.count(7);
    row.outcome.contacts = found.count(8);
    row.outcome.failure = failure_of(found.text(9)).value_or(Failure::none);
    row.outcome.trace_hash = found.text(10);
    int column = kFirstMeasure;
    for (const Measure& measure : all_measures())
      row.outcome.measures.*measure.value = found.number_if_any(column++);
    row.cost = {found.number(column), found.number(column + 1),
                read_laps(found.text(column + 2)).value_or(std::vector<LapCost>{})};
    return row;
  }

  static constexpr int kFirstMeasure = 11;  // of the columns

  const std::string file_;
  Database database_;
};

}  // namespace

Result<std::unique_ptr<Store>> Store::open(const std::string& file, const std::string& identity,
                                           const Origin& origin) {
  sqlite3* opened = nullptr;
  if (Status trusted = check_output_place(file); !trusted.ok())
    return fail(trusted.error().code, trusted.error().message, file);
  const int result = sqlite3_open(file.c_str(), &opened);
  Database database(opened);
  if (result != SQLITE_OK)
    return fail(Code::unavailable, file + " cannot be opened: " + sqlite3_errmsg(opened));
  auto store = std::make_unique<SqliteStore>(file, std::move(database));
  if (Status prepared = store->prepare(identity, origin); !prepared.ok()) return prepared.error();
  return std::unique_ptr<Store>(std::move(store));
}

}  // namespace orca::batch
