// SPDX-License-Identifier: GPL-3.0-or-later
// The file of results, whatever happens to the process that writes it.
#include "orca/batch/store.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <sqlite3.h>

#include <csignal>
#include <filesystem>
#include <vector>

#include "temp_folder.hpp"

using namespace orca;
using namespace orca::batch;
using orca::test::TempFolder;

namespace {

Row row(const std::string& variant, const std::string& world, std::uint64_t seed) {
  Row row{variant, world, seed, {}, {1.5, 2.5}};
  row.outcome.ending = Ending::success;
  row.outcome.time = 0.1 + 0.2;
  row.outcome.goals = 3;
  row.outcome.measures = {.way = 1.0 / 3.0, .clearance = 0.125};
  row.outcome.failure = Failure::oscillation;
  return row;
}

std::unique_ptr<Store> opened(const std::string& file, const std::string& identity = "1") {
  return Store::open(file, identity).value();
}

std::vector<Row> rows_of(const Store& store) {
  std::vector<Row> rows;
  REQUIRE(store.for_each([&](const Row& one) { rows.push_back(one); }).ok());
  return rows;
}

}  // namespace

TEST_CASE("results come out ordered and unchanged, whatever order they were added in", "[batch]") {
  const TempFolder folder;
  const auto store = opened(folder.file("r.sqlite"));
  for (const std::uint64_t seed : {18446744073709551615U, std::uint64_t{10}, std::uint64_t{9}})
    REQUIRE(store->add(row("b", "w", seed)).ok());
  REQUIRE(store->add(row("a", "x", 1)).ok());
  const std::vector<Row> rows = rows_of(*store);
  REQUIRE(rows.size() == 4);
  CHECK(rows[0].variant == "a");
  CHECK(rows[1].seed == 9);
  CHECK(rows[2].seed == 10);
  CHECK(rows[3].seed == 18446744073709551615U);
  CHECK(rows[3].outcome == row("", "", 0).outcome);
  CHECK(rows[3].cost.wall == 1.5);
  CHECK(rows[3].cost.cpu == 2.5);
}

TEST_CASE("a run that is there already is not added again", "[batch]") {
  const TempFolder folder;
  const auto store = opened(folder.file("r.sqlite"));
  REQUIRE(store->add(row("a", "w", 1)).ok());
  Row again = row("a", "w", 1);
  again.outcome.goals = 7;
  REQUIRE(store->add(again).ok());
  CHECK(rows_of(*store).at(0).outcome.goals == 3);
  CHECK(store->has("a", "w", 1));
  CHECK_FALSE(store->has("a", "w", 2));
}

TEST_CASE("what is drawn of a run is kept with it, and a map that many runs share is kept once", "[batch]") {
  const TempFolder folder;
  auto store = opened(folder.file("r.sqlite"));
  const std::string map(100'000, '1');
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    Row one = row("a", "w", seed);
    one.outcome.sketch = {"0.00 1.00," + std::to_string(seed), "0.50 0.50", seed == 50 ? map + "2" : map};
    REQUIRE(store->add(one).ok());
  }
  CHECK(store->sketch("a", "w", 7) == Sketch{"0.00 1.00,7", "0.50 0.50", map});
  CHECK(store->sketch("a", "w", 50).walls == map + "2");
  CHECK(store->sketch("b", "w", 7) == Sketch{});
  store.reset();  // brings what the write-ahead log holds into the file
  CHECK(std::filesystem::file_size(folder.file("r.sqlite")) < 1'000'000);
}

TEST_CASE("what came of making a run twice is kept, and where the results come from", "[batch]") {
  const TempFolder folder;
  {
    const auto store =
        Store::open(folder.file("r.sqlite"), "1", Origin{"/top/e.xml", {"/plugins/a", "/plugins/b c"}})
            .value();
    REQUIRE(store->add(RepeatRow{"v", "w", 18446744073709551615U, {"00", "11", "delivery 3, ..."}}).ok());
    REQUIRE(store->add(RepeatRow{"a", "w", 2, {"22", "22"}}).ok());
  }
  const auto store = opened(folder.file("r.sqlite"), "");
  const std::vector<RepeatRow> rows = store->repeats();
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].variant == "a");
  CHECK(rows[0].repeat == Repeat{"22", "22", ""});
  CHECK(rows[1].seed == 18446744073709551615U);
  CHECK(rows[1].repeat == Repeat{"00", "11", "delivery 3, ..."});
  CHECK(store->identity() == "1");
  CHECK(store->origin().file == "/top/e.xml");
  CHECK(store->origin().plugins == std::vector<std::string>{"/plugins/a", "/plugins/b c"});
}

TEST_CASE("a run is found by its names", "[batch]") {
  const TempFolder folder;
  const auto store = opened(folder.file("r.sqlite"));
  REQUIRE(store->add(row("a", "w", 7)).ok());
  REQUIRE(store->find("a", "w", 7));
  CHECK(store->find("a", "w", 7)->outcome == row("", "", 0).outcome);
  CHECK_FALSE(store->find("a", "w", 8));
}

TEST_CASE("results of another experiment are not mixed with these", "[batch]") {
  const TempFolder folder;
  REQUIRE(opened(folder.file("r.sqlite"), "1")->add(row("a", "w", 1)).ok());
  const auto other = Store::open(folder.file("r.sqlite"), "2");
  REQUIRE_FALSE(other);
  CHECK_THAT(other.error().message,
             Catch::Contains("results of another experiment") && Catch::Contains("--out"));
  CHECK(rows_of(*opened(folder.file("r.sqlite"), "")).size() == 1);
}

TEST_CASE("results of another version are refused, not read into the wrong columns", "[batch]") {
  const TempFolder folder;
  REQUIRE(opened(folder.file("r.sqlite"))->add(row("a", "w", 1)).ok());
  CHECK(Store::open(folder.file("r.sqlite"), {}));
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(folder.file("r.sqlite").c_str(), &database) == SQLITE_OK);
  REQUIRE(sqlite3_exec(database, "PRAGMA user_version = 0", nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_close(database);
  const auto older = Store::open(folder.file("r.sqlite"), {});
  REQUIRE_FALSE(older);
  CHECK_THAT(older.error().message, Catch::Contains("was made by another version of simbatch"));
}

TEST_CASE("a file that is no database, and a folder that is not there, are refused with the reason",
          "[batch]") {
  const TempFolder folder;
  const std::string text = folder.write("r.sqlite", std::string(5000, 'x'));
  CHECK_THAT(Store::open(text, "1").error().message, Catch::Contains("not a database"));
  CHECK_THAT(Store::open(folder.file("none/r.sqlite"), "1").error().message,
             Catch::Contains("unable to open database file"));
}

TEST_CASE("what add() has returned is in the file when its process is killed", "[batch]") {
  const TempFolder folder;
  const std::string file = folder.file("r.sqlite");
  const pid_t writer = fork();
  if (writer == 0) {
    const auto store = opened(file);
    for (std::uint64_t seed = 1; seed <= 50; ++seed)
      if (!store->add(row("a", "w", seed)).ok()) _exit(1);
    raise(SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(writer, &status, 0) == writer);
  REQUIRE(WIFSIGNALED(status));
  CHECK(rows_of(*opened(file)).size() == 50);
}

TEST_CASE("what runs depend on must not change between them; more may come", "[batch]") {
  const TempFolder folder;
  const auto store = opened(folder.file("r.sqlite"));
  REQUIRE(store->keep({{"plugin a.so", "1"}, {"world w", "2"}}).ok());
  CHECK(store->keep({{"plugin a.so", "1"}, {"world x", "3"}}).ok());
  const Status changed = store->keep({{"plugin a.so", "4"}, {"plugin b.so", "1"}, {"world w", "5"}});
  REQUIRE_FALSE(changed.ok());
  CHECK_THAT(changed.error().message, Catch::Contains("these were changed: plugin a.so, world w;"));
  CHECK(store->inputs() == Inputs{{"plugin a.so", "1"}, {"world w", "2"}, {"world x", "3"}});
}

namespace {

// A file with one run of variant "a" for each seed.
std::string part(const TempFolder& folder, const std::string& name, const std::vector<std::uint64_t>& seeds,
                 const std::string& identity = "1") {
  const auto store = opened(folder.file(name), identity);
  for (const std::uint64_t seed : seeds) REQUIRE(store->add(row("a", "w", seed)).ok());
  return folder.file(name);
}

}  // namespace

TEST_CASE("results of several files are put together, with runs that are in both once", "[batch]") {
  const TempFolder folder;
  const auto store = opened(folder.file("all"));
  REQUIRE(store->take_over(part(folder, "one", {1, 2})).ok());
  REQUIRE(store->take_over(part(folder, "two", {2, 3})).ok());
  const std::vector<Row> rows = rows_of(*store);
  REQUIRE(rows.size() == 3);
  CHECK(rows[2].outcome == row("", "", 0).outcome);
  CHECK(rows[2].cost.wall == 1.5);
}

TEST_CASE("results that do not fit are not put together, and nothing of them is taken", "[batch]") {
  const TempFolder folder;
  const auto store = opened(folder.file("all"));
  REQUIRE(store->take_over(part(folder, "one", {1, 2})).ok());
  CHECK_THAT(store->take_over(part(folder, "other", {3}, "2")).error().message,
             Catch::Contains("results of another experiment"));
  {
    const auto two = opened(folder.file("two"));
    Row changed = row("a", "w", 2);
    changed.outcome.time = 7.0;
    for (const Row& one : {row("a", "w", 3), changed}) REQUIRE(two->add(one).ok());
  }
  CHECK_THAT(store->take_over(folder.file("two")).error().message,
             Catch::Contains("has another outcome of variant a, world w, seed 2 than a folder before it"));
  REQUIRE(store->keep({{"plugin p.so", "1"}}).ok());
  REQUIRE(opened(part(folder, "three", {3}))->keep({{"plugin p.so", "2"}}).ok());
  CHECK_THAT(store->take_over(folder.file("three")).error().message, Catch::Contains("plugin p.so"));
  CHECK(rows_of(*store).size() == 2);
}

TEST_CASE("a declaration keeps its first date, and changes no run", "[batch]") {
  const TempFolder folder;
  const auto store = opened(folder.file("r.sqlite"));
  CHECK(store->declarations().empty());
  REQUIRE(store->declare({{"metrics", "time", "2026-11-28"}, {"seeds", "1-5", "2026-11-28"}}).ok());
  REQUIRE(store->add(row("a", "w", 1)).ok());
  REQUIRE(store->declare({{"metrics", "time", "2026-11-29"}, {"seeds", "1-9", "2026-11-29"}}).ok());
  const std::vector<Declaration> all = store->declarations();
  REQUIRE(all.size() == 3);
  CHECK(all[0].what == "metrics");
  CHECK(all[0].date == "2026-11-28");
  CHECK(all[2].text == "1-9");
  CHECK(all[2].date == "2026-11-29");
  CHECK(rows_of(*store).size() == 1);
}

TEST_CASE("what is declared after the first runs says so", "[batch]") {
  const TempFolder folder;
  const auto store = opened(folder.file("r.sqlite"));
  REQUIRE(store->add(row("a", "w", 1)).ok());
  REQUIRE(store->declare({{"metrics", "time", "2026-11-28"}}).ok());
  CHECK(store->declarations().at(0).date == "2026-11-28, after the first runs");
}

TEST_CASE("joined parts keep the earliest date of a declaration", "[batch]") {
  const TempFolder folder;
  const auto first = opened(folder.file("a.sqlite"));
  {
    const auto second = opened(folder.file("b.sqlite"));
    REQUIRE(second->declare({{"metrics", "time", "2026-11-27"}, {"seeds", "1", "2026-11-27"}}).ok());
  }
  REQUIRE(first->declare({{"metrics", "time", "2026-11-28"}}).ok());
  REQUIRE(first->take_over(folder.file("b.sqlite")).ok());
  const std::vector<Declaration> all = first->declarations();
  REQUIRE(all.size() == 2);
  CHECK(all[0].date == "2026-11-27");
  CHECK(all[1].what == "seeds");
}
