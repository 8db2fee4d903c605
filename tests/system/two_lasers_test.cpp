// SPDX-License-Identifier: GPL-3.0-or-later
// The graph of a robot with two lasers in one hardware: one looks over the pallets of its depot, the other one sees them.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr const char* kSecondLaser =
    R"(<connect from="lasers.low_LaserRangeReadingsPush" to="avoid.more_lasers"/>)";

Run drive(const std::string& graph, const Words& more) {
  return run_deployer(Words{graph, "--until", "250 s"} + virtual_clock() + more);
}

Run drive_shipped(const Words& more) { return drive(source_file("graphs/courier_depot.xml"), more); }

// The shipped graph with other words in place of some.
Run drive_changed(const std::string& old, const std::string& changed, const Words& more = {}) {
  const ShippedGraph graph("courier_depot");
  std::string text = graph.text();
  const std::size_t place = text.find(old);
  REQUIRE(place != std::string::npos);
  text.replace(place, old.size(), changed);
  const TempFolder folder;
  return drive(folder.write("graph.xml", text), more);
}

// The depot, in which a laser of the Courier is silent from the fifth second on.
std::string depot_with_outage(const TempFolder& folder, const std::string& laser) {
  std::string text = read_text(source_file("sim/worlds/depot.xml"));
  text.insert(text.find("</world>"),
              R"(<outage robot="Courier" sensor="laser" device=")" + laser + R"(" at="5 s"/>)");
  return folder.write("world.xml", text);
}

}  // namespace

TEST_CASE("a robot with two lasers drives round what only one of them sees", "[system][lasers]") {
  const std::string realism = GENERATE(as<std::string>{}, "nominal", "harsh");
  for (int seed = 1; seed <= part_of(10); ++seed) {
    const Run run = drive_shipped({"--seed", std::to_string(seed), "--set", "realism=" + realism});
    CAPTURE(realism, seed);
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.arrivals().size() == 3);
    CHECK(run.contacts().empty());
  }
}

TEST_CASE("with each of the avoid behaviours that listen to lasers it does", "[system][lasers]") {
  const std::string avoid =
      GENERATE(as<std::string>{}, "orca.VfhPlus", "orca.Dwa", "orca.NdPlus", "orca.PotentialField");
  const Run run = drive_shipped({"--set", "avoid=" + avoid});
  CAPTURE(avoid);
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.contacts().empty());
}

TEST_CASE("without the second laser it drives into a pallet", "[system][lasers]") {
  for (int seed = 1; seed <= part_of(5); ++seed) {
    const Run run = drive_changed(kSecondLaser, "", {"--seed", std::to_string(seed)});
    CAPTURE(seed);
    INFO(run.err);
    CHECK(run.exit_code() == 1);
    CHECK_FALSE(run.contacts().empty());
  }
}

TEST_CASE("it stands as long as either laser is silent", "[system][lasers]") {
  const std::string laser = GENERATE(as<std::string>{}, "high", "low");
  const TempFolder folder;
  const Run run = drive_shipped({"--set", "world=" + depot_with_outage(folder, laser)});
  CAPTURE(laser);
  INFO(run.err);
  CHECK(run.says("in the world: laser \"" + laser + "\" of Courier fails"));
  CHECK(run.exit_code() == 1);
  CHECK(run.arrivals().empty());
  CHECK(run.contacts().empty());
}

TEST_CASE("it stands when the laser that looks ahead is disconnected, and only one at the back is left",
          "[system][lasers]") {
  const TempFolder folder;
  std::string robot = read_text(source_file("sim/robots/courier.urdf"));
  const std::string high = R"(<origin xyz="0 0 0.3"/>)";
  REQUIRE(robot.find(high) != std::string::npos);
  robot.replace(robot.find(high), high.size(), R"(<origin xyz="0 0 0.3" rpy="0 0 3.14159"/>)");
  std::string text = ShippedGraph("courier_depot").text();
  text.erase(text.find(kSecondLaser), std::string(kSecondLaser).size());
  const Run run = drive_shipped({"--set", "robot=" + folder.write("robot.urdf", robot), "--change",
                                 folder.write("changed.xml", text) + "@3s"});
  INFO(run.err);
  CHECK(run.says("none of its lasers looks ahead"));
  CHECK(run.arrivals().empty());
  CHECK(run.contacts().empty());
}

TEST_CASE("further lasers need odometry, and the graph without it is refused with the reason",
          "[system][lasers]") {
  const Run run = drive_changed(R"(<connect from="base.OdometryPush" to="avoid.odometry"/>)", "");
  INFO(run.err);
  CHECK(run.exit_code() == kRefusedByComponent);
  CHECK(run.says("with further lasers, connect its port odometry too"));
}

TEST_CASE("the same run of a robot with two lasers has the same trace, whatever executor runs it",
          "[system][lasers][determinism]") {
  const auto hash = [](const char* executor) {
    const Run run = run_deployer({source_file("graphs/courier_depot.xml"), "--until", "250 s", "--clock",
                                  "virtual", "--executor", executor});
    INFO(run.err);
    REQUIRE(run.trace_hash());
    return *run.trace_hash();
  };
  const std::string baton = hash("baton");
  CHECK(hash(kThreadSanitizer ? "baton" : "fiber") == baton);  // ThreadSanitizer does not support fibers
}
