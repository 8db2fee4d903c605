// SPDX-License-Identifier: GPL-3.0-or-later
// The processes of a machine, and their places in the run page.
#include "members/roster.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::supervisor;

namespace {

graph::Graph graph_of(const std::vector<std::string>& processes) {
  graph::Graph graph;
  for (const std::string& name : processes) {
    graph.processes.push_back({.name = name});
    graph::ComponentNode node;
    node.name = "in_" + name;
    node.process = name;
    graph.components.push_back(node);
  }
  return graph;
}

}  // namespace

TEST_CASE("each process keeps its place and its object, whatever graph comes", "[supervisor][roster]") {
  Roster roster(graph_of({"base", "brain"}), "", {"base", "brain", "", ""});
  Member* const brain = roster.find("brain");
  REQUIRE(brain != nullptr);
  const graph::Graph second = graph_of({"eye", "brain"});
  REQUIRE(roster.reserve(second).ok());
  roster.go_over(second);
  REQUIRE(roster.all().size() == 2);
  CHECK(roster.all()[0]->name() == "eye");
  CHECK(roster.all()[0]->place() == 2);
  CHECK(roster.find("brain") == brain);
  CHECK(brain->place() == 1);
  CHECK(brain->index() == 1);
  CHECK(roster.find("base") == nullptr);
  CHECK(roster.at_place(0) == nullptr);
  CHECK(roster.at_place(1) == brain);
  const graph::Graph third = graph_of({"base"});
  REQUIRE(roster.reserve(third).ok());
  roster.go_over(third);
  CHECK(roster.find("base")->place() == 0);
}

TEST_CASE("if there are not enough places, none is given away", "[supervisor][roster]") {
  Roster roster(graph_of({"base"}), "", {"base", "", ""});
  const Status refused = roster.reserve(graph_of({"a", "b", "c"}));
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::failed_precondition);
  CHECK(roster.places() == std::vector<std::string>{"base", "", ""});
  CHECK(roster.reserve(graph_of({"a", "b"})).ok());
  CHECK(roster.places() == std::vector<std::string>{"base", "a", "b"});
}
