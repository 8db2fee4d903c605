// SPDX-License-Identifier: GPL-3.0-or-later
// A laser scanner on a post, hardware without a robot, and the graph in which a planner listens to it.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

const std::string kScanner = R"(to="planner.scanners")";
const std::string kLocalizer = R"(to="planner.localizer")";

// The shipped graph, with other elements in place of a connection.
Run drive(const std::string& connection, const std::string& elements, const Words& more = {}) {
  std::string text = printed("warehouse_scanner");
  const std::size_t place = text.find(connection);
  REQUIRE(place != std::string::npos);
  const std::size_t begin = text.rfind('<', place);
  text.replace(begin, text.find('>', place) + 1 - begin, elements);
  const TempFolder folder;
  return run_deployer(Words{folder.write("graph.xml", text), "--until", "200 s"} + virtual_clock() + more);
}

Run drive_shipped(const Words& more) {
  return run_deployer(Words{source_file("graphs/warehouse_scanner.xml"), "--until", "200 s"} +
                      virtual_clock() + more);
}

}  // namespace

TEST_CASE("what a scanner on a post sees saves the robot a way that is closed", "[system][scanner]") {
  for (int seed = 1; seed <= part_of(5); ++seed) {
    const Words words{"--seed", std::to_string(seed)};
    const Run with = drive_shipped(words);
    const Run without = drive(kScanner, "", words);
    CAPTURE(seed);
    INFO(with.err << without.err);
    REQUIRE(with.arrivals().size() == 1);
    REQUIRE(without.arrivals().size() == 1);
    CHECK(with.contacts().empty());
    CHECK(without.arrivals()[0].t > 1.3 * with.arrivals()[0].t);
  }
}

TEST_CASE("a scanner that sees the robot takes it for no obstacle", "[system][scanner]") {
  // To the end of the aisle and back, under the eyes of the scanner. If the map held what that sees of the robot, it would find no
  // way back.
  const Run run = drive_shipped({"--set", "goals=end: 14 6; mouth: 4.5 6", "--set", "realism=harsh"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 2);
  CHECK(run.arrivals()[1].t < 60.0);
  CHECK(run.contacts().empty());
}

TEST_CASE("hardware without a robot has sensors, and nothing that moves", "[system][scanner]") {
  const Run run = drive(kScanner, R"(<component name="mast" type="orca.RobotBaseServer" hardware="scanner"/>
                         <connect from="fuser.base" to="mast.MotionCommandSend"/>)");
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("MotionCommandSend"));
  CHECK(run.says("LaserRangeReadingsPush"));
}

TEST_CASE("scanners need a localizer, and a graph without it is refused with the reason",
          "[system][scanner]") {
  const Run run = drive(kLocalizer, "");
  INFO(run.err);
  CHECK(run.exit_code() == kRefusedByComponent);
  CHECK(run.says("with scanners, connect its port localizer too: they see places of the world"));
}
