// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/wiring.hpp"

#include <catch2/catch.hpp>

#include "open_descriptors.hpp"
#include "orca/patterns/shm/ring_segment.hpp"

using namespace orca;
using namespace orca::supervisor;

namespace {

graph::Edge edge(const std::string& from, const std::string& to) {
  graph::Edge made;
  made.from = {from, "out"};
  made.to = {to, "in"};
  return made;
}

// Processes one, two, three; a and b are in one.
graph::Graph system() {
  graph::Graph graph;
  for (const auto& [name, process] : {std::pair("a", "one"), {"b", "one"}, {"c", "two"}, {"d", "three"}}) {
    graph::ComponentNode node;
    node.name = name;
    node.process = process;
    graph.components.push_back(node);
  }
  graph.edges = {edge("a", "b"), edge("a", "c"), edge("d", "b")};
  return graph;
}

std::vector<std::size_t> edges_of(const Wiring::Lots& lots, const std::string& process) {
  std::vector<std::size_t> edges;
  if (const auto lot = lots.by_process.find(process); lot != lots.by_process.end())
    for (const EdgeMemory& memory : lot->second) edges.push_back(memory.edge);
  return edges;
}

}  // namespace

TEST_CASE("only edges between processes get memory, and both ends get the same", "[supervisor][wiring]") {
  const Wiring wiring(system());
  const auto lots = wiring.deal({"one", "two", "three"});
  REQUIRE(lots);
  CHECK(edges_of(*lots, "one") == std::vector<std::size_t>{1, 2});
  CHECK(edges_of(*lots, "two") == std::vector<std::size_t>{1});
  CHECK(edges_of(*lots, "three") == std::vector<std::size_t>{2});
  const auto here = SharedMemory::map(lots->by_process.at("one")[0].memory.number());
  const auto there = SharedMemory::map(lots->by_process.at("two")[0].memory.number());
  REQUIRE(here);
  REQUIRE(there);
  here->bytes()[9000] = std::byte{42};
  CHECK(there->bytes()[9000] == std::byte{42});
}

TEST_CASE("a process that is started again gets new memory for its edges, and so do its neighbours",
          "[supervisor][wiring]") {
  const Wiring wiring(system());
  const auto lots = wiring.deal({"two"});
  REQUIRE(lots);
  CHECK(edges_of(*lots, "one") == std::vector<std::size_t>{1});
  CHECK(edges_of(*lots, "two") == std::vector<std::size_t>{1});
  CHECK(edges_of(*lots, "three").empty());
}

TEST_CASE("the edges at a process are known by both of their ends", "[supervisor][wiring]") {
  const Wiring wiring(system());
  CHECK(wiring.edges_at("one").size() == 2);
  REQUIRE(wiring.edges_at("three").size() == 1);
  CHECK(wiring.edges_at("three")[0].name == "d.out to b.in");
  CHECK(wiring.edges_at("three")[0].from == "three");
  CHECK(wiring.edges_at("three")[0].to == "one");
}

TEST_CASE("memory that nobody takes leaves no descriptor behind", "[supervisor][wiring]") {
  const Wiring wiring(system());
  const std::size_t before = test::open_descriptors();
  REQUIRE(wiring.deal({"one"}));
  CHECK(test::open_descriptors() == before);
}
