// SPDX-License-Identifier: GPL-3.0-or-later
// SonarAvoid with sonars and odometry as the controllers of real bases tell them: over a slow line, some readings several times.
#include <algorithm>
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "record_table.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

// Returns the behaviour's commands of that part of a run.
std::vector<RecordTable::Row> commands(const Words& settings, double from, double to) {
  const TempFolder folder;
  const std::string file = folder.file("motion.csv");
  const Run run = run_deployer(
      Words{system_graph("slow_ring.xml"), "--until", "3 s", "--record", file + "=avoid.motion"} + settings +
      with_test_plugins() + virtual_clock());
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  auto rows = RecordTable(file).rows("avoid.motion");
  std::erase_if(rows,
                [&](const auto& row) { return number(row, "stamp") < from || number(row, "stamp") > to; });
  REQUIRE(rows.size() > 1);
  return rows;
}

bool has_opinion(const RecordTable::Row& command) { return command.at("kind") != "DONTCARE"; }

}  // namespace

TEST_CASE("an echo that was heard once and told twice is soon forgotten", "[system][avoid]") {
  const Words once{"--set", "ring.echoes=1"};
  CHECK(std::ranges::all_of(commands(once, 1.0, 1.1), has_opinion));
  CHECK(std::ranges::none_of(commands(once, 1.6, 3.0), has_opinion));
}

TEST_CASE("an echo that was heard twice is remembered", "[system][avoid]") {
  CHECK(std::ranges::all_of(commands({"--set", "ring.echoes=2"}, 1.0, 3.0), has_opinion));
}

// At 60 degrees from where the robot points there is room beside it; half a second of its turn nearer there is none.
TEST_CASE("an echo is where the robot heard it, however late the line brings it", "[system][avoid]") {
  const auto heard_at = [](const std::string& bearing, const std::string& lag) {
    return commands({"--set", "ring.echoes=1", "--set", "ring.turn_rate=1", "--set",
                     "ring.bearing=" + bearing, "--set", "ring.lag=" + lag},
                    1.0, 1.1);
  };
  CHECK(std::ranges::all_of(heard_at("31 deg", "0 s"), has_opinion));
  CHECK(std::ranges::none_of(heard_at("60 deg", "0 s"), has_opinion));
  CHECK(std::ranges::none_of(heard_at("60 deg", "0.5 s"), has_opinion));
}
