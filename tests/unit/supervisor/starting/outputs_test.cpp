// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/outputs.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::supervisor;
using Catch::Contains;

namespace {

graph::Graph graph_in(const std::string& of_goto, const std::string& of_base) {
  graph::Graph graph;
  for (const auto& [name, process] : {std::pair("goto", of_goto), {"base", of_base}}) {
    graph::ComponentNode& node = graph.components.emplace_back();
    node.name = name;
    node.process = process;
  }
  graph::HardwareNode& scout = graph.hardware.emplace_back();
  scout.name = "scout";
  scout.process = of_base;
  for (const std::string& process : {of_goto, of_base})
    if (process != graph::kMainProcess) graph.processes.push_back({.name = process});
  return graph;
}

host::RunOutputs all_outputs() {
  host::RunOutputs outputs;
  outputs.recordings = {{"a.csv", {"goto.path"}}, {"b.csv", {"base.odometry", "base.sonar"}}};
  outputs.picture.file = "run.svg";
  outputs.looks_on = true;
  return outputs;
}

}  // namespace

TEST_CASE("one process writes all outputs", "[supervisor][outputs]") {
  const graph::Graph graph = graph_in("main", "main");
  host::RunOutputs outputs = all_outputs();
  outputs.trace_file = "trace";
  CHECK(check_outputs(graph, outputs).ok());
  const host::RunOutputs own = outputs_of(graph, "main", outputs);
  CHECK(own.trace_file == "trace");
  CHECK(own.recordings.size() == 2);
  CHECK(own.picture.file == "run.svg");
}

TEST_CASE("of several processes each writes what goes through it", "[supervisor][outputs]") {
  const graph::Graph graph = graph_in("behaviours", "base");
  REQUIRE(check_outputs(graph, all_outputs()).ok());
  const host::RunOutputs behaviours = outputs_of(graph, "behaviours", all_outputs());
  REQUIRE(behaviours.recordings.size() == 1);
  CHECK(behaviours.recordings[0].file == "a.csv");
  CHECK(behaviours.picture.file.empty());
  CHECK(behaviours.looks_on);
  const host::RunOutputs base = outputs_of(graph, "base", all_outputs());
  REQUIRE(base.recordings.size() == 1);
  CHECK(base.recordings[0].file == "b.csv");
  CHECK(base.picture.file == "run.svg");
}

TEST_CASE("what no process can write alone is refused, with the processes", "[supervisor][outputs]") {
  graph::Graph graph = graph_in("behaviours", "base");
  host::RunOutputs outputs;
  outputs.trace_file = "trace";
  CHECK_THAT(check_outputs(graph, outputs).error().message, Contains("--trace"));
  outputs = {};
  outputs.recordings = {{"a.csv", {"goto.path", "base.odometry"}}};
  CHECK_THAT(check_outputs(graph, outputs).error().message,
             Contains("--record a.csv") && Contains("base, behaviours"));
  graph.hardware.emplace_back().process = "behaviours";
  outputs = {};
  outputs.picture.file = "run.svg";
  CHECK_THAT(check_outputs(graph, outputs).error().message,
             Contains("--picture") && Contains("base, behaviours"));
}
