// SPDX-License-Identifier: GPL-3.0-or-later
// The order in which connections change, and how they go back.
#include "applying/edge_steps.hpp"

#include <catch2/catch.hpp>
#include <memory>
#include <set>
#include <string>
#include <variant>
#include <vector>

using namespace orca;
using namespace orca::supervisor;
using Rewirings = std::vector<graph::GraphPlan::Rewiring>;
using Words = std::vector<std::string>;

namespace {

// Servers s (process "p") and t ("q"), and clients c ("q") and d ("p").
graph::Graph four_components() {
  graph::Graph graph;
  for (const auto& [name, process] :
       {std::pair("s", "p"), std::pair("t", "q"), std::pair("c", "q"), std::pair("d", "p")}) {
    graph::ComponentNode node;
    node.name = name;
    node.process = process;
    graph.components.push_back(node);
  }
  return graph;
}

graph::Edge edge(const std::string& server, const std::string& client) {
  graph::Edge edge;
  edge.from = {server, "out"};
  edge.to = {client, "in"};
  return edge;
}

std::string text(const Order& order) {
  std::string text;
  for (const EdgeChange& change : std::get<Rewire>(order).changes)
    text += (text.empty() ? "" : ", ") + std::string(change.makes ? "+" : "-") +
            change.edge.server().component + change.edge.client().component +
            (change.memory ? " with memory" : "");
  return text;
}

// A change that was planned: "component: go / back" for each step.
struct Planned {
  Words words;
  std::vector<JointStep> steps;
  std::unique_ptr<std::set<std::string>> left = std::make_unique<std::set<std::string>>();
};

Planned plan(const Rewirings& rewirings, const std::set<std::string>& lost = {}) {
  Planned planned;
  planned.steps = edge_steps(four_components(), rewirings, lost, *planned.left).value();
  for (JointStep& step : planned.steps) {
    CHECK_FALSE(step.may_obey_late);
    const std::optional<ThereAndBack> orders = *step.make();
    planned.words.push_back(step.component + ": " + text(orders->go) + " / " + text(orders->back));
  }
  return planned;
}

}  // namespace

TEST_CASE("the server's end of a new edge is made before its client's", "[supervisor][edges]") {
  CHECK(plan({{std::nullopt, edge("s", "c")}}).words ==
        Words{"s: +sc with memory / -sc", "c: +sc with memory / -sc"});
}

TEST_CASE("the server's end of an edge that goes, or changes, waits for its client", "[supervisor][edges]") {
  CHECK(plan({{edge("s", "c"), std::nullopt}}).words ==
        Words{"c: -sc / +sc with memory", "s: -sc / +sc with memory"});
  CHECK(plan({{edge("s", "c"), edge("s", "c")}}).words ==
        Words{"c: +sc with memory / +sc with memory", "s: +sc with memory / +sc with memory"});
}

TEST_CASE("a client goes over to its new server before it leaves the old one, and this one is the last",
          "[supervisor][edges]") {
  CHECK(plan({{edge("s", "c"), std::nullopt}, {std::nullopt, edge("t", "c")}}).words ==
        Words{"c: +tc, -sc / +sc with memory, -tc", "s: -sc / +sc with memory"});
  CHECK(plan({{edge("t", "d"), std::nullopt}, {std::nullopt, edge("s", "d")}}).words ==
        Words{"d: +sd, -td / +td with memory, -sd", "t: -td / +td with memory"});
}

TEST_CASE("each step concerns one component, also within a process", "[supervisor][edges]") {
  CHECK(plan({{std::nullopt, edge("s", "d")}, {edge("t", "c"), std::nullopt}}).words ==
        Words{"c: -tc / +tc", "d: +sd / -sd"});
}

TEST_CASE("a lost process takes no part", "[supervisor][edges]") {
  CHECK(plan({{std::nullopt, edge("s", "c")}}, {"p"}).words == Words{"c: +sc with memory / -sc"});
}

TEST_CASE("edges between processes that were there are noted once their clients have left them",
          "[supervisor][edges]") {
  Planned planned = plan({{edge("s", "c"), edge("s", "c")}, {edge("t", "c"), std::nullopt}});
  CHECK(planned.left->empty());
  planned.steps.front().obeyed(true);
  CHECK(*planned.left == std::set<std::string>{"s.out to c.in"});
  planned.steps.front().obeyed(false);
  CHECK(*planned.left == std::set<std::string>{"s.out to c.in"});
}
