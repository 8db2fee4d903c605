// SPDX-License-Identifier: GPL-3.0-or-later
// The ports that the robot base of the thesis's run exports (thesis Fig. 11.3).
#include <catch2/catch.hpp>
#include <set>

#include "deployer.hpp"
#include "orca/graph/loader.hpp"
#include "orca/host/catalogue.hpp"

using namespace orca::test;

namespace {

// Returns the ports of a component with hardware, as the graph checker finds them.
std::set<std::string> exported(const std::string& graph_file, const std::string& component) {
  orca::host::PluginCatalogue catalogue{orca::plugin::PluginIndex({ORCA_BINARY_DIR "/plugins"})};
  orca::xml::Diagnostics diagnostics;
  const auto graph = orca::graph::load_file(source_file(graph_file), {}, catalogue, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(graph);
  const auto* const server = graph->find_component(component);
  REQUIRE(server != nullptr);
  const auto* const hardware = graph->find_hardware(server->hardware);
  REQUIRE(hardware != nullptr);
  const orca::graph::HardwareUse use{hardware->name, hardware->type, hardware->params};
  const orca::Result<orca::Contract> contract = catalogue.component(server->type, &use);
  REQUIRE(contract.has_value());
  std::set<std::string> names;
  for (const orca::PortContract& port : contract->ports) {
    CHECK(port.role == orca::Role::server);
    names.insert(port.name);
  }
  CHECK(names.size() == contract->ports.size());
  return names;
}

}  // namespace

TEST_CASE(
    "the Scout exports the five hardware interfaces of thesis Fig. 11.3, its bumpers, its battery and its "
    "description, no more",
    "[system][scout]") {
  CHECK(exported("graphs/scout_goto.xml", "base") ==
        std::set<std::string>{"BatteryPush", "BatteryQuery", "BumperReadingsPush", "BumperReadingsQuery",
                              "MotionCommandSend", "OdometryPush", "OdometryQuery", "RobotQuery",
                              "SonarRangeReadingsPush", "SonarRangeReadingsQuery"});
}

TEST_CASE("a LaserServer exports Push and Query of the laser's readings and its description, nothing else",
          "[system][laser]") {
  CHECK(exported("graphs/pioneer_laser_goto.xml", "laser") ==
        std::set<std::string>{"LaserRangeReadingsPush", "LaserRangeReadingsQuery", "LaserSensorQuery"});
}

TEST_CASE("of two lasers each has its own ports, which begin with its name", "[system][laser]") {
  CHECK(exported("graphs/courier_depot.xml", "lasers") ==
        std::set<std::string>{"high_LaserRangeReadingsPush", "high_LaserRangeReadingsQuery",
                              "low_LaserRangeReadingsPush", "low_LaserRangeReadingsQuery",
                              "LaserSensorQuery"});
}

TEST_CASE("a RobotBaseServer around the same hardware exports all of its sensors", "[system][laser]") {
  CHECK(exported("graphs/pioneer_laser_goto.xml", "base").contains("LaserRangeReadingsPush"));
}

TEST_CASE("a graph that asks the Scout for a laser is refused with the list of its ports",
          "[system][scout]") {
  const Run run = run_deployer(Words{system_graph("laser_from_scout.xml")} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.out.empty());
  CHECK(run.says("LaserRangeReadingsPush"));
  CHECK(run.says("SonarRangeReadingsPush"));
}
