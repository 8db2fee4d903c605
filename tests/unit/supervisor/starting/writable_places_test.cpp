// SPDX-License-Identifier: GPL-3.0-or-later
#include "starting/writable_places.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace orca;
using namespace orca::supervisor;

namespace {

using Names = std::vector<std::string>;

Contract with_param(const std::string& name, bool is_file) {
  Contract contract;
  ParamContract param;
  param.name = name;
  param.file = is_file;
  contract.params = {param};
  return contract;
}

// A component in each of two processes, and hardware in the first.
struct WritingSystem {
  WritingSystem() {
    add("log", "one", "file", std::string("/var/log/robot/run.log"), true);
    add("title", "one", "text", std::string("/opt/robot/title"), false);
    add("maps", "two", "maps", Names{"/srv/maps/a.yaml", "b.yaml"}, true);
    graph::HardwareNode robot;
    robot.name = "robot";
    robot.process = "one";
    robot.params["robot"] = std::string("/usr/share/robot.urdf");
    graph.hardware.push_back(robot);
    facts.drivers["robot"] = with_param("robot", true);
  }
  void add(const std::string& name, const std::string& process, const std::string& param,
           const ParamValue& value, bool is_file) {
    graph::ComponentNode node;
    node.name = name;
    node.process = process;
    node.params[param] = value;
    graph.components.push_back(node);
    facts.contracts[name] = with_param(param, is_file);
  }
  [[nodiscard]] Names places(const std::string& process, const host::RunOutputs& outputs = {}) const {
    return writable_places(graph, process, facts, outputs);
  }

  graph::Graph graph;
  SystemFacts facts;
};

}  // namespace

TEST_CASE("a process writes in the folders of files that its own parameters name, and of no other texts",
          "[supervisor][starter]") {
  const WritingSystem system;
  CHECK(system.places("one") == Names{"/usr/share", "/var/log/robot"});
  CHECK_THAT(system.places("two"),
             Catch::UnorderedEquals(Names{std::filesystem::current_path().string(), "/srv/maps"}));
  CHECK(system.places("three").empty());
}

TEST_CASE("a process writes in the folders of the run's outputs", "[supervisor][starter]") {
  host::RunOutputs outputs;
  outputs.trace_file = "/data/traces/run.trace";
  outputs.recordings.push_back({"/data/run.csv", {"base.odometry"}});
  CHECK(WritingSystem().places("three", outputs) == Names{"/data", "/data/traces"});
}
