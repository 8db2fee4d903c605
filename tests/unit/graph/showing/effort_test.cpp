// SPDX-License-Identifier: GPL-3.0-or-later
// What a change of a running system costs those who run on, and what cannot be had without a new start.
#include <catch2/catch.hpp>

#include <string>
#include <utility>
#include <vector>

#include "orca/graph/plan.hpp"

using namespace orca;
using graph::Effort;

namespace {

// Two components that have nothing to do with each other.
graph::Graph two_alone() {
  graph::Graph graph;
  graph.name = "two";
  for (const std::string name : {"stays", "goes"}) {
    graph::ComponentNode node;
    node.name = name;
    node.type = "orca.LogServer";
    graph.components.push_back(node);
  }
  return graph;
}

bool can_let_the_last_go(const graph::Graph& running) {
  graph::Graph wanted = running;
  wanted.components.pop_back();
  return plan_of(running, wanted, {}, graph::PlanMeans{false, {}}).is_possible();
}

}  // namespace

TEST_CASE("a component that is there on demand, on one of several machines, or chooses from others cannot go",
          "[graph][apply]") {
  CHECK(can_let_the_last_go(two_alone()));
  graph::Graph on_demand = two_alone();
  on_demand.components.back().on_demand = true;
  CHECK_FALSE(can_let_the_last_go(on_demand));
  graph::Graph several_machines = two_alone();
  for (const std::string name : {"here", "there"}) several_machines.machines.push_back({.name = name});
  CHECK_FALSE(can_let_the_last_go(several_machines));
  graph::Graph choosing = two_alone();
  choosing.components.back().ports["pose"].candidates = {{"a", "b"}};
  CHECK_FALSE(can_let_the_last_go(choosing));
}

TEST_CASE("each effort says what stops meanwhile", "[graph][apply]") {
  const std::vector<std::pair<Effort, std::string>> said{
      {Effort::none, "at once; nothing runs otherwise"},
      {Effort::set, "between two laps; nothing stops"},
      {Effort::rewire, "between two laps; no other connection notices"},
      {Effort::add, "comes up beside the others; nothing stops"},
      {Effort::remove, "ends when its connections are gone; nothing else stops"},
      {Effort::exchange, "tried for 1 s, then exchanged between two laps; nothing stops"},
      {Effort::renew, "its process is started again; what runs there stops meanwhile"},
      {Effort::restart, "only when the system is started again"}};
  for (const auto& [effort, text] : said) CHECK(to_string(effort) == text);
}
