// SPDX-License-Identifier: GPL-3.0-or-later
// Which runs of an experiment are still to be made, here and in one of several parts.
#include "orca/batch/missing_runs.hpp"

#include <catch2/catch.hpp>

#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "temp_folder.hpp"

using namespace orca;
using namespace orca::batch;
using orca::test::TempFolder;

namespace {

Experiment large(const std::string& seeds) {
  xml::Diagnostics diagnostics;
  const auto read = read_experiment(
      "<experiment name=\"e\" graph=\"g.xml\" seeds=\"" + seeds +
          "\" until=\"1 s\"><variant name=\"a\"/><variant name=\"b\"/><world name=\"w\"/><world "
          "name=\"x\"/></experiment>",
      "/top/e.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(read);
  return *read;
}

std::vector<std::size_t> all_of(MissingRuns runs) {
  std::vector<std::size_t> all;
  while (const auto run = runs.next()) all.push_back(*run);
  return all;
}

// From here on, most_memory() does not know what was before.
void forget_most_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

// [kB] The most memory that this process has used.
std::size_t most_memory() {
  std::ifstream lines("/proc/self/status");
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("VmHWM:")) return std::stoul(line.substr(6));
  return 0;
}

}  // namespace

TEST_CASE("the runs that a store does not hold are missing, in their order", "[batch]") {
  const TempFolder folder;
  const auto store = Store::open(folder.file("r.sqlite"), "1").value();
  const Experiment experiment = large("1-3");
  REQUIRE(store->add(Row{"b", "w", 2, {}, {}}).ok());
  const MissingRuns missing(experiment, *store, {});
  CHECK(missing.count() == 11);
  CHECK(missing.count_with({0, 3}) == 12);  // run 3 is there, and made again
  const std::vector<std::size_t> all = all_of(missing);
  CHECK(all == std::vector<std::size_t>{0, 1, 2, 4, 5, 6, 7, 8, 9, 10, 11});
}

TEST_CASE("the parts of an experiment hold each run once, and never part the variants of a world and seed",
          "[batch]") {
  const TempFolder folder;
  const auto store = Store::open(folder.file("r.sqlite"), "1").value();
  const Experiment experiment = large("1-5");
  for (const std::size_t count : {1, 2, 7, 30}) {
    std::multiset<std::size_t> found;
    for (std::size_t number = 1; number <= count; ++number) {
      const std::vector<std::size_t> part = all_of({experiment, *store, {number, count}});
      for (std::size_t i = 0; i < part.size(); i += 2) CHECK(part[i] + 1 == part.at(i + 1));
      found.insert(part.begin(), part.end());
    }
    CHECK(found.size() == 20);
    CHECK(std::set<std::size_t>(found.begin(), found.end()).size() == 20);
  }
}

TEST_CASE("one run in seven of each variant is to be made twice, up to seven, and one in a hundred beyond",
          "[batch]") {
  const TempFolder folder;
  const auto store = Store::open(folder.file("r.sqlite"), "1").value();
  const auto twice = [&](const std::string& seeds) {
    return MissingRuns(large(seeds), *store, {}).not_repeated().size() / 2;
  };
  CHECK(twice("1") == 1);        // of 2 runs of each variant
  CHECK(twice("1-10") == 3);     // of 20
  CHECK(twice("1-50") == 7);     // of 100
  CHECK(twice("1-300") == 7);    // of 600
  CHECK(twice("1-1000") == 20);  // of 2000
}

TEST_CASE("the runs that are made twice are spread over worlds and seeds, the same places for each variant",
          "[batch]") {
  const TempFolder folder;
  const auto store = Store::open(folder.file("r.sqlite"), "1").value();
  const Experiment experiment = large("1-50");
  std::set<std::size_t> worlds;
  std::set<std::uint64_t> seeds;
  const std::vector<std::size_t> runs = MissingRuns(experiment, *store, {}).not_repeated();
  REQUIRE(runs.size() == 14);
  for (std::size_t i = 0; i < runs.size(); i += 2) {
    CHECK(runs[i] + 1 == runs[i + 1]);
    worlds.insert(experiment.run(runs[i]).world);
    seeds.insert(experiment.run(runs[i]).seed);
  }
  CHECK(worlds.size() == 2);
  CHECK(seeds.size() == 7);
}

TEST_CASE("runs of each variant in a part are to be made twice, unless as many of that variant were",
          "[batch]") {
  const TempFolder folder;
  const auto store = Store::open(folder.file("r.sqlite"), "1").value();
  const Experiment experiment = large("1-5");
  CHECK(MissingRuns(experiment, *store, {}).not_repeated() == std::vector<std::size_t>{0, 1, 10, 11});
  CHECK(MissingRuns(experiment, *store, {3, 7}).not_repeated() == std::vector<std::size_t>{4, 5});
  CHECK(MissingRuns(experiment, *store, {30, 30}).not_repeated().empty());
  REQUIRE(store->add(RepeatRow{"a", "x", 4, {"1", "1"}}).ok());
  CHECK(MissingRuns(experiment, *store, {}).not_repeated() == std::vector<std::size_t>{1, 10, 11});
}

// Sanitizers keep what was freed.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kFreesMemory = false;
#else
constexpr bool kFreesMemory = true;
#endif

TEST_CASE("a list of a hundred thousand runs takes no memory", "[batch]") {
  const TempFolder folder;
  const auto store = Store::open(folder.file("r.sqlite"), "1").value();
  const Experiment experiment = large("1-25000");
  MissingRuns missing(experiment, *store, {});
  REQUIRE(missing.next() == 0U);  // the database is in memory now
  forget_most_memory();
  const std::size_t before = most_memory();
  REQUIRE(before > 0);
  CHECK(missing.count() == 100'000);
  std::size_t handed_out = 1;
  while (missing.next()) ++handed_out;
  CHECK(handed_out == 100'000);
  if (kFreesMemory) CHECK(most_memory() < before + 500);  // a list of numbers alone would take 800 kB
}
