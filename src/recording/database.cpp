// SPDX-License-Identifier: LGPL-3.0-or-later
// Bags of ROS 2 in SQLite. All schema versions have the two tables that are read, with the same columns:
//   topics(id, name, type, serialization_format, ...)   messages(id, topic_id, timestamp [ns since 1970], data)
// Source: the storage plugin rosbag2_storage_sqlite3 (Apache 2.0), read for its facts.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "sqlite.hpp"
#include "storage.hpp"

namespace orca::recording {
namespace {

constexpr std::string_view kBegin{"SQLite format 3\0", 16};
constexpr std::int64_t kNewestSchema = 4;
constexpr std::size_t kMostMessages = 20'000'000;  // whose times are kept, 24 bytes each
constexpr std::size_t kMostTopics = 10'000;
constexpr std::size_t kLeastBytes = 8;                           // of a message's row in a file
constexpr std::size_t kLargestMessage = std::size_t{512} << 20;  // [bytes] of a message
constexpr std::size_t kMostFaults = 20;                          // that are reported of one file

// What is kept of a message until it is read.
struct Place {
  Stamp time;
  std::int64_t row;
  std::uint16_t channel;
};

class DatabaseStorage final : public Storage {
 public:
  DatabaseStorage(Database database, std::string path)
      : database_(std::move(database)), path_(std::move(path)) {}

  Status read_structure();
  void find_messages();

  Status messages(const std::set<std::uint16_t>& channels, const std::function<bool(const Message&)>& take,
                  Stamp from) const override;
  [[nodiscard]] Examination examine() const;

 private:
  [[nodiscard]] std::string fault() const { return sqlite3_errmsg(database_.get()); }
  [[nodiscard]] Error no_bag(const std::string& why) const {
    return fail(Code::invalid_argument, "this SQLite database is no bag of rosbag2: " + why, path_);
  }
  // Returns why SQLite did not answer.
  [[nodiscard]] Error refusal() const {
    const int state = sqlite3_errcode(database_.get());
    if (state != SQLITE_CORRUPT && state != SQLITE_NOTADB) return no_bag(fault());
    return fail(Code::data_loss, "the database is damaged or cut off: " + fault() + advice(), path_);
  }
  [[nodiscard]] std::string advice() const { return "; " + rescue_of(path_); }
  Status check_programs() const;
  Status read_version();
  Status read_topics();
  [[nodiscard]] std::map<std::string, std::string> read_definitions() const;

  const Database database_;
  const std::string path_;
  std::map<std::int64_t, std::uint16_t> channels_;  // by id in the file
  std::vector<Place> places_;                       // in the order of time
  std::uint64_t late_ = 0;                          // messages that are earlier than the one written before
};

Status DatabaseStorage::read_structure() {
  for (const auto part : {&DatabaseStorage::read_version, &DatabaseStorage::read_topics})
    if (Status done = (this->*part)(); !done.ok()) return done;
  return ok();
}

// What a schema has beside tables and their indexes, and columns that are computed, are programs. A bag has none.
Status DatabaseStorage::check_programs() const {
  Statement programs(database_.get(),
                     "SELECT name FROM sqlite_schema WHERE sql NOT NULL AND sql NOT LIKE 'CREATE TABLE %' "
                     "AND sql NOT LIKE 'CREATE INDEX %' AND sql NOT LIKE 'CREATE UNIQUE INDEX %'");
  if (programs.step())
    return no_bag("it has a view, a trigger or a virtual table, '" + programs.text(0) + "'");
  if (programs.has_failed()) return refusal();
  Statement computed(database_.get(),
                     "SELECT name FROM pragma_table_xinfo('messages') WHERE hidden <> 0 UNION ALL "
                     "SELECT name FROM pragma_table_xinfo('topics') WHERE hidden <> 0");
  if (computed.step()) return no_bag("its column '" + computed.text(0) + "' is computed");
  return computed.has_failed() ? Status(refusal()) : ok();
}

// Versions 1 and 2 do not say which they are.
Status DatabaseStorage::read_version() {
  if (Status plain = check_programs(); !plain.ok()) return plain;
  Statement version(database_.get(), "SELECT schema_version, ros_distro FROM schema");
  library = "rosbag2, in SQLite";
  if (!version.step()) return ok();
  const std::int64_t number = version.number(0);
  if (number > kNewestSchema)
    return fail(Code::failed_precondition,
                "the bag has schema version " + std::to_string(number) + "; versions up to " +
                    std::to_string(kNewestSchema) + " are known: convert it to MCAP with ros2 bag convert",
                path_);
  library += " by ROS 2 " + version.text(1) + ", schema version " + std::to_string(number);
  return ok();
}

Status DatabaseStorage::read_topics() {
  const std::map<std::string, std::string> definitions = read_definitions();
  std::map<std::string, std::uint16_t> schemas;
  std::size_t count = 0;  // of rows: a damaged table may have no end
  Statement topics(database_.get(), "SELECT id, name, type, serialization_format FROM topics NOT INDEXED");
  while (topics.step()) {
    if (++count > kMostTopics) return no_bag("it has more than 10,000 topics");
    const auto number = static_cast<std::uint16_t>(channels_.size() + 1);
    const std::string type = topics.text(2);
    const auto [schema, is_new] = schemas.try_emplace(type, static_cast<std::uint16_t>(schemas.size() + 1));
    const auto fields = definitions.find(type);
    if (is_new)
      summary.schemas[schema->second] = {schema->second, type, "ros2msg",
                                         fields == definitions.end() ? "" : fields->second};
    if (!channels_.try_emplace(topics.number(0), number).second) continue;
    summary.channels[number] = {number, schema->second, topics.text(1), topics.text(3), {}};
  }
  return topics.has_failed() ? Status(refusal()) : ok();
}

// Returns the fields of types, which schema version 4 keeps.
std::map<std::string, std::string> DatabaseStorage::read_definitions() const {
  std::map<std::string, std::string> definitions;
  std::size_t count = 0;
  Statement rows(database_.get(),
                 "SELECT topic_type, encoded_message_definition FROM message_definitions NOT INDEXED "
                 "WHERE encoding = 'ros2msg'");
  while (rows.step() && ++count <= kMostTopics) definitions[rows.text(0)] = rows.text(1);
  return definitions;
}

// Reads when messages came, from the table alone: an index may say something else.
void DatabaseStorage::find_messages() {
  const std::size_t most = std::min<std::uint64_t>(kMostMessages, size / kLeastBytes);
  std::uint64_t strange = 0;
  Stamp last = 0;
  Statement rows(database_.get(), "SELECT rowid, topic_id, timestamp FROM messages NOT INDEXED");
  while (rows.step() && places_.size() + strange < most) {
    const auto channel = channels_.find(rows.number(1));
    if (channel == channels_.end() || !rows.is_number(2) || rows.number(2) < 0) {
      ++strange;
      continue;
    }
    const auto time = static_cast<Stamp>(rows.number(2));
    if (time < last) ++late_;
    last = time;
    places_.push_back({time, rows.number(0), channel->second});
    summary.count({channel->second, 0, time, time, {}});
  }
  if (rows.has_failed()) findings.push_back({0, "the database is damaged: " + fault() + advice()});
  if (!rows.has_failed() && places_.size() + strange >= most)
    findings.push_back({0, "it has more messages than " + std::to_string(most) +
                               ", which is too much, or more than its size allows"});
  if (strange > 0)
    findings.push_back({0, std::to_string(strange) + " messages have no time, or a topic that is not there"});
  has_index = findings.empty();
  std::ranges::sort(places_, {}, [](const Place& place) { return std::pair(place.time, place.row); });
}

Status DatabaseStorage::messages(const std::set<std::uint16_t>& channels,
                                 const std::function<bool(const Message&)>& take, Stamp from) const {
  Statement row(database_.get(), "SELECT data FROM messages NOT INDEXED WHERE rowid = ?");
  const auto first = std::ranges::lower_bound(places_, from, {}, &Place::time);
  for (auto place = first; place != places_.end(); ++place) {
    if (!channels.empty() && !channels.contains(place->channel)) continue;
    row.ask_for(place->row);
    const std::optional<std::span<const std::byte>> payload =
        row.step() ? row.bytes(0) : std::optional<std::span<const std::byte>>();
    if (!payload)
      return fail(Code::data_loss, "message " + std::to_string(place->row) + " of the bag cannot be read: " +
                                       (row.has_failed() ? fault() : "its data are no bytes") + advice());
    if (!take({place->channel, 0, place->time, place->time, *payload})) return ok();
  }
  return findings.empty() ? ok() : fail(Code::data_loss, findings.front().text);
}

Examination DatabaseStorage::examine() const {
  Examination examined{findings, {}, size, {}};
  Statement pages(database_.get(), "PRAGMA quick_check(20)");
  while (pages.step())
    if (const std::string text = pages.text(0); text != "ok" && examined.findings.size() < kMostFaults)
      examined.findings.push_back({0, "the database is damaged: " + text});
  std::map<std::uint16_t, std::uint64_t> bare;  // messages without an encapsulation
  const Status read = messages(
      {},
      [&](const Message& message) {
        ++examined.statistics.messages;
        if (message.payload.size() < 4 || message.payload[0] != std::byte{0}) ++bare[message.channel];
        return true;
      },
      0);
  if (!read.ok() && findings.empty()) examined.findings.push_back({0, read.error().message});
  for (const auto& [channel, count] : bare)
    if (summary.channels.at(channel).message_encoding == "cdr")
      examined.findings.push_back({0, summary.channels.at(channel).topic + ": " + std::to_string(count) +
                                          " messages do not begin as CDR does"});
  if (late_ > 0)
    examined.remarks.push_back(std::to_string(late_) +
                               " messages are earlier than the one that was written before them");
  return examined;
}

// A database whose writer was interrupted has a part of its content beside it, which SQLite would put in its place, writing.
Status check_leftovers(const std::string& path) {
  for (const char* const ending : {"-wal", "-journal"}) {
    std::error_code absent;
    const std::uintmax_t bytes = std::filesystem::file_size(path + ending, absent);
    if (absent || bytes == 0) continue;
    return fail(Code::failed_precondition,
                "its recorder was interrupted, or goes on: a part of the bag is still in " + path + ending +
                    "; when the recorder has ended, let SQLite put it in its place: sqlite3 " + path +
                    " \"PRAGMA journal_mode=DELETE\"",
                path);
  }
  return ok();
}

Result<std::unique_ptr<DatabaseStorage>> open_bag(const std::string& path) {
  if (const Status done = check_leftovers(path); !done.ok()) return done.error();
  Result<Database> database = open_read_only(path, kLargestMessage);
  if (!database) return database.error();
  auto storage = std::make_unique<DatabaseStorage>(*std::move(database), path);
  std::error_code unused;
  storage->size = std::filesystem::file_size(path, unused);
  if (const Status read = storage->read_structure(); !read.ok()) return read.error();
  storage->find_messages();
  return storage;
}

}  // namespace

// Debian's sqlite3 has no .recover. A dump of a damaged file takes itself back at its end.
std::string rescue_of(const std::string& path) {
  return "sqlite3 " + path +
         " .dump | sed 's/^ROLLBACK.*/COMMIT;/' | sqlite3 NEW.db3 writes what is whole into a new file";
}

bool is_database(std::span<const std::byte> bytes) {
  return bytes.size() >= kBegin.size() && std::memcmp(bytes.data(), kBegin.data(), kBegin.size()) == 0;
}

Result<std::unique_ptr<Storage>> open_database(const std::string& path) {
  Result<std::unique_ptr<DatabaseStorage>> storage = open_bag(path);
  if (!storage) return storage.error();
  return std::unique_ptr<Storage>(*std::move(storage));
}

Result<Examination> check_database(const std::string& path) {
  const Result<std::unique_ptr<DatabaseStorage>> storage = open_bag(path);
  if (!storage) return storage.error();
  return (*storage)->examine();
}

}  // namespace orca::recording
