// SPDX-License-Identifier: GPL-3.0-or-later
// The graph of a robot with a gripper, which fetches a can and puts it down elsewhere.
#include <catch2/catch.hpp>

#include <cmath>
#include <regex>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr double kTableX = 6.3;  // [m] of the goal "table" in the graph
constexpr double kTableY = 4.5;

Run fetch(const Words& more) {
  return run_deployer(Words{source_file("graphs/pioneer_fetch.xml"), "--until", "200 s"} + virtual_clock() +
                      more);
}

const Words kFetched{"near_shelf", "shelf", "near_table", "table"};

// Returns how far from a place the can stands at last [m]; nothing if it was not put down.
std::optional<double> apart_from(double x, double y, const Run& run) {
  const std::regex put_down("has put down 'can' at \\(([-0-9.]+), ([-0-9.]+)\\) m");
  std::smatch found;
  if (!std::regex_search(run.err, found, put_down)) return std::nullopt;
  return std::hypot(std::stod(found[1]) - x, std::stod(found[2]) - y);
}

// The store, without what `pattern` matches.
std::string store_without(const TempFolder& folder, const std::string& pattern) {
  const std::string text = read_text(source_file("sim/worlds/store.xml"));
  const std::string changed = std::regex_replace(text, std::regex(pattern), "");
  REQUIRE(changed != text);
  return folder.write("world.xml", changed);
}

}  // namespace

TEST_CASE("the can stands on the table's place afterwards", "[system][gripper]") {
  const std::string realism = GENERATE(as<std::string>{}, "nominal", "harsh");
  for (int seed = 1; seed <= part_of(10); ++seed) {
    const Run run = fetch({"--seed", std::to_string(seed), "--set", "realism=" + realism});
    CAPTURE(realism, seed);
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.goals() == kFetched);
    CHECK(run.contacts().empty());
    CHECK(run.says("has taken 'can'"));
    CHECK(apart_from(kTableX, kTableY, run).value_or(9.9) < 0.1);
  }
}

TEST_CASE("where there is no can, the goal is not reached, with the reason", "[system][gripper]") {
  const TempFolder folder;
  const Run run = fetch({"--set", "world=" + store_without(folder, "<item [^>]*/>")});
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.goals() == Words{"near_shelf", "near_table"});
  CHECK(run.says("goal \"shelf\" was not reached; undone: nothing came between the paddles"));
  CHECK(run.says("there is nothing between the paddles to be put down"));
}

TEST_CASE("a goal where nothing is to be done is Goto's alone", "[system][gripper]") {
  const Run run = fetch({"--set", "goals=elsewhere: 3 4.5"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
  CHECK_FALSE(run.says("has taken"));
}

TEST_CASE("a robot without gripper is refused before anything runs", "[system][gripper]") {
  const Run run = fetch({"--set", "robot=" + source_file("sim/robots/pioneer_2dx.urdf")});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("GripperCommandSend"));
}

TEST_CASE("with the real driver and the emulated controller it does the same",
          "[system][gripper][hardware]") {
  const TempFolder folder;
  const std::string line = folder.path().filename().string();
  const Run run = run_deployer(
      {source_file("graphs/pioneer_fetch.xml"), "--profile", "emulate", "--set", "emulated=" + line, "--set",
       "place=shelf", "--set", "goals=shelf: 6.3 1.5; table: 4.9 1.5"},
      Seconds(120));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == kFetched);
  CHECK(run.contacts().empty());
  CHECK(apart_from(4.9, 1.5, run).value_or(9.9) < 0.1);
}
