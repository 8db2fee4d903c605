// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/graph/placement.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

#include "orca/base/random.hpp"

using namespace orca;
using namespace orca::graph;

namespace {

ComponentNode component(const std::string& name, const std::string& process,
                        std::vector<std::string> start_after = {}) {
  ComponentNode node;
  node.name = name;
  node.process = process;
  node.start_after = std::move(start_after);
  return node;
}

HardwareNode hardware(const std::string& name, const std::string& process) {
  HardwareNode node;
  node.name = name;
  node.process = process;
  return node;
}

Edge edge(const std::string& from, const std::string& to) {
  Edge result;
  result.from = {from, "out"};
  result.to = {to, "in"};
  return result;
}

ProcessNode process(const std::string& name) { return {.name = name}; }

std::vector<std::string> names_of(const std::vector<ProcessNode>& processes) {
  std::vector<std::string> names;
  for (const ProcessNode& node : processes) names.push_back(node.name);
  return names;
}

using Names = std::vector<std::string>;
using Indices = std::vector<std::size_t>;

// Two processes and what the graph leaves in "main".
Graph placed_robot() {
  Graph graph;
  graph.processes = {process("behaviours"), process("empty"), process("base")};
  graph.hardware = {hardware("scout", "base")};
  graph.components = {component("command", "main"), component("goto", "behaviours"),
                      component("base", "base"), component("avoid", "behaviours")};
  graph.edges = {edge("goto", "avoid"), edge("base", "avoid"), edge("avoid", "base"), edge("command", "goto"),
                 edge("base", "command")};
  return graph;
}

}  // namespace

TEST_CASE("a graph that names no process has one, with default settings", "[graph][placement]") {
  Graph graph;
  graph.components = {component("a", "main")};
  const std::vector<ProcessNode> processes = processes_of(graph);
  REQUIRE(processes.size() == 1);
  CHECK(processes[0] == ProcessNode{.name = "main"});
  CHECK(processes_of(Graph{}).empty());
}

TEST_CASE("processes come in the order of the graph, main last, and none in which nothing runs",
          "[graph][placement]") {
  Graph graph = placed_robot();
  CHECK(names_of(processes_of(graph)) == Names{"behaviours", "base", "main"});
  graph.processes.insert(graph.processes.begin(), process("main"));
  graph.processes[0].priority = 5;
  CHECK(names_of(processes_of(graph)) == Names{"main", "behaviours", "base"});
  CHECK(processes_of(graph)[0].priority == 5);
}

TEST_CASE("a process in which only hardware runs is one", "[graph][placement]") {
  Graph graph;
  graph.hardware = {hardware("scout", "main")};
  CHECK(names_of(processes_of(graph)) == Names{"main"});
}

TEST_CASE("the part of a process has its components, its hardware and the edges at them",
          "[graph][placement]") {
  const ProcessPart behaviours = part_of(placed_robot(), "behaviours");
  CHECK(behaviours.components == Names{"goto", "avoid"});
  CHECK(behaviours.hardware.empty());
  CHECK(behaviours.edges_within == Indices{0});
  CHECK(behaviours.edges_out == Indices{2});
  CHECK(behaviours.edges_in == Indices{1, 3});
  const ProcessPart base = part_of(placed_robot(), "base");
  CHECK(base.hardware == Names{"scout"});
  CHECK(base.edges_out == Indices{1, 4});
  CHECK(base.edges_in == Indices{2});
}

TEST_CASE("each edge is within one process, or leaves one and enters another", "[graph][placement]") {
  const Graph graph = placed_robot();
  std::vector<int> within(graph.edges.size());
  std::vector<int> out(graph.edges.size());
  std::vector<int> in(graph.edges.size());
  for (const ProcessNode& node : processes_of(graph)) {
    const ProcessPart part = part_of(graph, node.name);
    for (const std::size_t i : part.edges_within) ++within[i];
    for (const std::size_t i : part.edges_out) ++out[i];
    for (const std::size_t i : part.edges_in) ++in[i];
  }
  CHECK(out == in);
  for (std::size_t i = 0; i < graph.edges.size(); ++i) CHECK(within[i] + out[i] == 1);
}

TEST_CASE("components come up in the order of the graph, unless start_after says otherwise",
          "[graph][placement]") {
  Graph graph;
  graph.components = {component("a", "main", {"c", "d"}), component("b", "main"),
                      component("c", "main", {"d"}), component("d", "main"), component("e", "main")};
  CHECK(start_order(graph) == Names{"b", "d", "c", "a", "e"});
  CHECK(start_order(Graph{}).empty());
}

TEST_CASE("a component named twice in start_after is waited for once", "[graph][placement]") {
  Graph graph;
  graph.components = {component("a", "main", {"b", "b"}), component("b", "main")};
  CHECK(start_order(graph) == Names{"b", "a"});
}

TEST_CASE("of all components that could be next, the first of the graph is", "[graph][placement][property]") {
  RandomStream random(1, "graph", "start order");
  for (int run = 0; run < 200; ++run) {
    Graph graph;
    const std::size_t count = 1 + random() % 12;
    for (std::size_t i = 0; i < count; ++i) graph.components.push_back(component(std::to_string(i), "main"));
    for (std::size_t i = 1; i < count;
         ++i)  // an edge of the order between any two, in one of both directions
      for (std::size_t k = 0; k < i; ++k)
        if (random() % 4 == 0) graph.components[i].start_after.push_back(std::to_string(k));
    std::ranges::reverse(graph.components);
    Names up;
    for (const std::string& next : start_order(graph)) {
      const auto can_be_next = [&](const ComponentNode& node) {
        const auto is_up = [&](const std::string& name) { return std::ranges::count(up, name) > 0; };
        return !is_up(node.name) && std::ranges::all_of(node.start_after, is_up);
      };
      const auto first = std::ranges::find_if(graph.components, can_be_next);
      REQUIRE(first != graph.components.end());
      REQUIRE(first->name == next);
      up.push_back(next);
    }
    REQUIRE(up.size() == count);
  }
}

TEST_CASE("a subgraph has what runs in one process, and the edges within it", "[graph][placement]") {
  Graph graph = placed_robot();
  graph.edges.push_back(edge("avoid", "goto"));
  const Graph part = subgraph(graph, "behaviours");
  REQUIRE(part.components.size() == 2);
  CHECK(part.components[0].name == "goto");
  CHECK(part.components[1].name == "avoid");
  CHECK(part.hardware.empty());
  REQUIRE(part.edges.size() == 2);
  CHECK(part.edges[0].to.component == "avoid");
  CHECK(part.edges[1].to.component == "goto");
  CHECK(part.processes == graph.processes);
}

TEST_CASE("the subgraph of a process in which nothing runs is empty", "[graph][placement]") {
  const Graph part = subgraph(placed_robot(), "empty");
  CHECK(part.components.empty());
  CHECK(part.hardware.empty());
  CHECK(part.edges.empty());
}

TEST_CASE("of a graph on two machines each has its processes, and what is in them", "[graph][placement]") {
  Graph graph = placed_robot();
  graph.machines = {{.name = "near"}, {.name = "far"}, {.name = "spare"}};
  graph.processes[0].machine = "far";
  graph.processes[2].machine = "near";
  graph.processes.push_back({.name = "main", .machine = "near"});
  graph.ends = {"command", "goto"};
  CHECK(names_of(processes_on(graph, "near")) == Names{"base", "main"});
  CHECK(names_of(processes_on(graph, "far")) == Names{"behaviours"});
  CHECK(processes_on(graph, "spare").empty());
  CHECK(machine_of(graph, "avoid") == "far");
  const Graph near = part_on(graph, "near");
  REQUIRE(near.components.size() == 2);
  CHECK(near.components[0].name == "command");
  CHECK(near.components[1].name == "base");
  CHECK(near.hardware.size() == 1);
  CHECK(near.edges == std::vector{edge("base", "command")});
  CHECK(near.ends == Names{"command"});
  CHECK(part_on(graph, "far").ends == Names{"goto"});
}

TEST_CASE("without machines everything runs on the one that has no name", "[graph][placement]") {
  const Graph graph = placed_robot();
  CHECK(names_of(processes_on(graph, "")) == names_of(processes_of(graph)));
  CHECK(part_on(graph, "") == graph);
  CHECK(machine_of(graph, "command").empty());
}
