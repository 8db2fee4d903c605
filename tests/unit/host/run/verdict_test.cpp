// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/host/verdict.hpp"

#include <catch2/catch.hpp>

#include <map>

using namespace orca;
using namespace orca::host;

namespace {

using States = std::map<std::string, ComponentReport>;

ComponentReport report_of(ComponentState state) {
  ComponentReport report;
  report.state = state;
  return report;
}

ComponentReport failed_because(const std::string& why) {
  return {ComponentState::idle, true, true, true, why};
}

Reports of(const States& states) {
  return [states](const std::string& component) { return states.at(component); };
}

// Two components, both named in `ends`.
graph::Graph two() {
  graph::Graph graph;
  graph.ends = {"a", "b"};
  for (const std::string& name : graph.ends) {
    graph::ComponentNode node;
    node.name = name;
    graph.components.push_back(node);
  }
  return graph;
}

}  // namespace

TEST_CASE("a run without ends never comes to an end by itself", "[host][verdict]") {
  graph::Graph graph = two();
  graph.ends.clear();
  const States done{{"a", report_of(ComponentState::work_done)}, {"b", report_of(ComponentState::work_done)}};
  CHECK_FALSE(ending(graph, of(done)).has_value());
}

TEST_CASE("a run has ended when all that it waits for are done", "[host][verdict]") {
  States states{{"a", report_of(ComponentState::work_done)}, {"b", report_of(ComponentState::work)}};
  CHECK_FALSE(ending(two(), of(states)).has_value());
  CHECK(unfinished(two(), of(states)) == std::vector<std::string>{"b (WORK)"});
  states["b"] = report_of(ComponentState::work_done);
  const auto end = ending(two(), of(states));
  REQUIRE(end.has_value());
  CHECK(end->ok());
  CHECK(unfinished(two(), of(states)).empty());
}

TEST_CASE("a run has failed as soon as one of them has that may not", "[host][verdict]") {
  const States states{{"a", report_of(ComponentState::work)}, {"b", failed_because("no way")}};
  const auto end = ending(two(), of(states));
  REQUIRE(end.has_value());
  REQUIRE_FALSE(end->ok());
  CHECK(end->error().message == "no way");
  CHECK(end->error().where == "b");
}

TEST_CASE("one that may fail counts as done when it has failed", "[host][verdict]") {
  graph::Graph graph = two();
  graph.components[1].may_fail = true;
  States states{{"a", report_of(ComponentState::work)}, {"b", failed_because("no way")}};
  CHECK_FALSE(ending(graph, of(states)).has_value());
  CHECK(failed_components(graph, of(states)).empty());
  states["a"] = report_of(ComponentState::work_done);
  const auto end = ending(graph, of(states));
  REQUIRE(end.has_value());
  CHECK(end->ok());
}

TEST_CASE("the error of a run names the one component that has failed, or lists them", "[host][verdict]") {
  States states{{"a", report_of(ComponentState::idle)}, {"b", failed_because("no way")}};
  auto failed_ones = failed_components(two(), of(states));
  REQUIRE(failed_ones == std::vector<std::string>{"b"});
  CHECK(failure_of(failed_ones, of(states)).message == "no way");
  CHECK(failure_of(failed_ones, of(states)).where == "b");
  states["a"] = failed_because("nor here");
  failed_ones = failed_components(two(), of(states));
  REQUIRE(failed_ones.size() == 2);
  CHECK(failure_of(failed_ones, of(states)).message == "a, b ended in WORK_FAILED");
}
