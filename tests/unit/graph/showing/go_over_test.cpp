// SPDX-License-Identifier: GPL-3.0-or-later
// The graph of a run after it went over to another one: in which order it has its components, and where.
#include <catch2/catch.hpp>

#include "orca/graph/diff.hpp"
#include "orca/graph/plan.hpp"

using namespace orca;
using graph::go_over;

namespace {

using Names = std::vector<std::string>;

graph::Graph graph_of(const Names& components) {
  graph::Graph graph;
  for (const std::string& name : components) {
    graph.components.emplace_back();
    graph.components.back().name = name;
  }
  return graph;
}

}  // namespace

TEST_CASE(
    "where components have come or gone they are in the order of the wanted graph, and on the way back as "
    "before",
    "[graph][apply]") {
  const graph::Graph before = graph_of(Names{"a", "b", "c"});
  graph::Graph running = before;
  for (const graph::Graph& wanted :
       {graph_of(Names{"b", "c"}), before, graph_of(Names{"a", "d", "b"}), before}) {
    go_over(running, wanted);
    CHECK(running.components == wanted.components);
  }
}

TEST_CASE("where none has come or gone the nodes stay, since others refer to them", "[graph][apply]") {
  graph::Graph running = graph_of(Names{"a", "b", "c"});
  const graph::ComponentNode* const first = running.find_component("a");
  graph::Graph wanted = graph_of(Names{"c", "b", "a"});
  wanted.components.back().params["margin"] = 0.7;
  go_over(running, wanted);
  CHECK(running.find_component("a") == first);
  CHECK(first->params == wanted.components.back().params);
  CHECK(graph::diff(running, wanted).empty());
}
