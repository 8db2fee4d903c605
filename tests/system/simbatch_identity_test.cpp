// SPDX-License-Identifier: GPL-3.0-or-later
// A shipped experiment gives the same bytes however it is run. Each case makes all of its runs anew: some minutes in all.
#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "batches.hpp"
#include "deployer.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr Seconds kLimit{600};
constexpr std::size_t kRuns = 12 * 4 * 10;

// A shipped experiment, with a number of seeds.
std::string shipped(const std::string& name, const TempFolder& folder, const std::string& its_seeds,
                    const std::string& seeds) {
  std::string text = text_in(source_file("sim/experiments/" + name));
  const auto replace = [&](const std::string& before, const std::string& after) {
    const std::size_t at = text.find(before);
    REQUIRE(at != std::string::npos);
    text.replace(at, before.size(), after);
  };
  replace("seeds=\"" + its_seeds + "\"", "seeds=\"" + seeds + "\"");
  while (text.find("../../graphs/") != std::string::npos) replace("../../graphs/", source_file("graphs/"));
  return folder.write(name, text);
}

std::string office(const TempFolder& folder, const std::string& seeds) {
  return shipped("avoid_office.xml", folder, "1-10", seeds);
}

// Returns the ordered export of a batch of its own.
std::string made(const std::string& experiment, const std::string& out, const Words& more = {}) {
  const Run run = run_simbatch(Words{experiment, "--out", out} + more, kLimit);
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return exported(out);
}

Words cells_of(const std::string& line) {
  Words cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

// Programs that want all processors.
std::vector<std::unique_ptr<Subprocess>> load() {
  std::vector<std::unique_ptr<Subprocess>> hogs;
  for (int i = 0; i < 6; ++i)
    hogs.push_back(std::make_unique<Subprocess>(Words{"/bin/sh", "-c", "while :; do :; done"}));
  return hogs;
}

// Starts a batch, kills it with all its workers once some of its runs are finished, and makes the rest.
std::string killed_and_resumed(const std::string& experiment, const std::string& out) {
  Subprocess program(simbatch({experiment, "--out", out, "--jobs", "2"}));
  REQUIRE(program.wait_for_output("; LaserAvoid ", kLimit));
  program.send(SIGKILL);
  (void)program.wait(kLimit);
  const std::size_t finished = split_lines(exported(out)).size() - 1;
  CHECK(finished > 0);
  CHECK(finished < kRuns);
  return made(experiment, out, {"--resume"});
}

std::string in_seven_parts(const std::string& experiment, const TempFolder& folder) {
  Words parts;
  for (int i = 1; i <= 7; ++i) {
    parts.push_back(folder.file("part" + std::to_string(i)));
    (void)made(experiment, parts.back(), {"--shard", std::to_string(i) + "/7"});
  }
  const Run joined = run_simbatch(Words{"join"} + parts + Words{"--out", folder.file("joined")}, kLimit);
  INFO(joined.err);
  REQUIRE(joined.exit_code() == 0);
  return exported(folder.file("joined"));
}

}  // namespace

TEST_CASE("the office experiment gives the same bytes however it is run", "[.][slow][batch]") {
  const TempFolder folder;
  const std::string experiment = office(folder, "1-10");
  const std::string whole = made(experiment, folder.file("whole"));
  REQUIRE(split_lines(whole).size() == 1 + kRuns);

  for (int i = 2; i <= 5; ++i) {
    INFO("repeat " << i);
    CHECK(made(experiment, folder.file("repeat" + std::to_string(i))) == whole);
  }
  CHECK(made(experiment, folder.file("one"), {"--jobs", "1"}) == whole);
  CHECK(made(experiment, folder.file("two"), {"--jobs", "2"}) == whole);
  CHECK(made(experiment, folder.file("baton"), {"--executor", "baton"}) == whole);
  CHECK(in_seven_parts(experiment, folder) == whole);
  CHECK(killed_and_resumed(experiment, folder.file("killed")) == whole);
  {
    const auto hogs = load();
    CHECK(made(experiment, folder.file("loaded"), {"--jobs", "3"}) == whole);
  }
}

TEST_CASE("seeds matter at nominal and harsh; at ideal all seeds are one run", "[system][batch]") {
  const TempFolder folder;
  std::map<std::string, std::set<std::string>> ways;  // [m] true ones, by variant and world
  std::map<std::string, std::set<std::string>> hashes;
  Words lines = split_lines(made(shipped("sonar_physics.xml", folder, "1-20", "1-2"), folder.file("out")));
  const Words names = cells_of(lines.front());
  const auto column = [&](const std::string& name) { return std::ranges::find(names, name) - names.begin(); };
  for (auto line = lines.begin() + 1; line != lines.end(); ++line) {
    const Words cells = cells_of(*line);
    const std::string place = cells.at(column("variant")) + " " + cells.at(column("world"));
    ways[place].insert(cells.at(column("way")));
    hashes[place].insert(cells.at(column("trace_hash")));
  }
  REQUIRE(ways.size() == 20);
  for (const auto& [place, different] : ways) {
    CAPTURE(place);
    const bool is_ideal = place.find("ideal") != std::string::npos;
    CHECK(different.size() == (is_ideal ? 1 : 2));
    CHECK(hashes[place].size() == (is_ideal ? 1 : 2));
  }
}

TEST_CASE(
    "behaviours are compared through drivers of emulated devices, with the same bytes for 1 and 2 workers",
    "[system][batch]") {
  const TempFolder folder;
  const std::size_t seeds = is_slow_run() ? 2 : 1;
  const std::string experiment = shipped("emulated_office.xml", folder, "1-20", seeds == 2 ? "1-2" : "1");
  const std::string one = made(experiment, folder.file("one"), {"--jobs", "1"});
  CHECK(made(experiment, folder.file("two"), {"--jobs", "2"}) == one);
  const Words lines = split_lines(one);
  REQUIRE(lines.size() == 1 + 4 * 2 * seeds);
  const Words names = cells_of(lines.front());
  const auto ending = std::ranges::find(names, "ending") - names.begin();
  const auto hash = std::ranges::find(names, "trace_hash") - names.begin();
  std::set<std::string> hashes;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    CHECK(cells_of(lines[i]).at(ending) == "success");
    hashes.insert(cells_of(lines[i]).at(hash));
  }
  CHECK(hashes.size() == lines.size() - 1);  // a driver changes the run, and so does the seed
}
