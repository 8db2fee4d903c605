// SPDX-License-Identifier: GPL-3.0-or-later
#include "starting/wiring.hpp"

#include <sys/stat.h>
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
graph::Graph wired_processes() {
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

std::vector<std::string> edges_of(const Wiring::Lots& lots, const std::string& process) {
  std::vector<std::string> edges;
  if (const auto lot = lots.by_process.find(process); lot != lots.by_process.end())
    for (const EdgeMemory& memory : lot->second) edges.push_back(memory.edge);
  return edges;
}

}  // namespace

TEST_CASE("only edges between processes get memory, and both ends get the same", "[supervisor][wiring]") {
  Wiring wiring(wired_processes());
  const auto lots = wiring.deal({"one", "two", "three"});
  REQUIRE(lots);
  CHECK(edges_of(*lots, "one") == std::vector<std::string>{"a.out to c.in", "d.out to b.in"});
  CHECK(edges_of(*lots, "two") == std::vector<std::string>{"a.out to c.in"});
  CHECK(edges_of(*lots, "three") == std::vector<std::string>{"d.out to b.in"});
  const auto here = SharedMemory::map(lots->by_process.at("one")[0].memory.number());
  const auto there = SharedMemory::map(lots->by_process.at("two")[0].memory.number());
  REQUIRE(here);
  REQUIRE(there);
  here->bytes()[9000] = std::byte{42};
  CHECK(there->bytes()[9000] == std::byte{42});
}

TEST_CASE("a process that is started again gets new memory for its edges, and so do its neighbours",
          "[supervisor][wiring]") {
  Wiring wiring(wired_processes());
  const auto lots = wiring.deal({"two"});
  REQUIRE(lots);
  CHECK(edges_of(*lots, "one") == std::vector<std::string>{"a.out to c.in"});
  CHECK(edges_of(*lots, "two") == std::vector<std::string>{"a.out to c.in"});
  CHECK(edges_of(*lots, "three").empty());
}

TEST_CASE("single edges get new memory, at both ends", "[supervisor][wiring]") {
  Wiring wiring(wired_processes());
  const auto lots = wiring.deal_edges({"a.out to b.in", "d.out to b.in", "no.such to edge.here"});
  REQUIRE(lots);
  CHECK(edges_of(*lots, "one") == std::vector<std::string>{"d.out to b.in"});
  CHECK(edges_of(*lots, "three") == std::vector<std::string>{"d.out to b.in"});
  CHECK(edges_of(*lots, "two").empty());
}

TEST_CASE("after the graph has gone over to other edges, those get memory", "[supervisor][wiring]") {
  Wiring wiring(wired_processes());
  graph::Graph other = wired_processes();
  other.edges = {edge("d", "a")};
  wiring.go_over(other);
  const auto lots = wiring.deal({"one", "two", "three"});
  REQUIRE(lots);
  CHECK(edges_of(*lots, "one") == std::vector<std::string>{"d.out to a.in"});
  CHECK(edges_of(*lots, "two").empty());
}

TEST_CASE("the edges at a process are known by both of their ends", "[supervisor][wiring]") {
  Wiring wiring(wired_processes());
  CHECK(wiring.edges_at("one").size() == 2);
  REQUIRE(wiring.edges_at("three").size() == 1);
  CHECK(wiring.edges_at("three")[0].name == "d.out to b.in");
  CHECK(wiring.edges_at("three")[0].from == "three");
  CHECK(wiring.edges_at("three")[0].to == "one");
}

namespace {

std::uint64_t file_of(const Descriptor& descriptor) {
  struct stat status {};
  return descriptor && fstat(descriptor.number(), &status) == 0 ? status.st_ino : 0;
}

// Returns the pool of a process's peer, as the process gets it with an edge.
std::uint64_t pool_at(const Wiring::Lots& lots, const std::string& process, std::size_t edge = 0) {
  return file_of(lots.by_process.at(process).at(edge).pool);
}

}  // namespace

TEST_CASE("each process gets a pool, and its peers get the same", "[supervisor][wiring]") {
  Wiring wiring(wired_processes());
  const auto lots = wiring.deal({"one", "two", "three"});
  REQUIRE(lots);
  CHECK(lots->pools.size() == 3);
  CHECK(lots->by_process.at("two")[0].peer == "one");
  CHECK(pool_at(*lots, "two") == file_of(lots->pools.at("one")));
  CHECK(pool_at(*lots, "one", 0) == file_of(lots->pools.at("two")));
  CHECK(pool_at(*lots, "one", 1) == file_of(lots->pools.at("three")));
  CHECK(file_of(lots->pools.at("one")) != file_of(lots->pools.at("two")));
}

TEST_CASE("a peer's pool comes with the first edge to it", "[supervisor][wiring]") {
  graph::Graph graph = wired_processes();
  graph.edges.push_back(edge("b", "c"));
  Wiring wiring(graph);
  const auto lots = wiring.deal({"one", "two"});
  REQUIRE(lots);
  CHECK(pool_at(*lots, "two", 0) != 0);
  CHECK(pool_at(*lots, "two", 1) == 0);
}

TEST_CASE("a process that is started again gets another pool, and its peers keep theirs",
          "[supervisor][wiring]") {
  Wiring wiring(wired_processes());
  const auto first = wiring.deal({"one", "two", "three"});
  REQUIRE(first);
  const auto again = wiring.deal({"two"});
  REQUIRE(again);
  CHECK(again->pools.size() == 1);
  CHECK(pool_at(*again, "one") == file_of(again->pools.at("two")));
  CHECK(pool_at(*again, "one") != pool_at(*first, "one"));
  CHECK(pool_at(*again, "two") == file_of(first->pools.at("one")));
  CHECK(again->by_process.at("one")[0].peer_is_new);
  CHECK_FALSE(again->by_process.at("two")[0].peer_is_new);
}

TEST_CASE("memory that nobody takes leaves no descriptor behind", "[supervisor][wiring]") {
  Wiring wiring(wired_processes());
  REQUIRE(wiring.deal({"one", "two", "three"}));  // it keeps their pools
  const std::size_t before = test::open_descriptors();
  REQUIRE(wiring.deal({"one"}));
  CHECK(test::open_descriptors() == before);
}

namespace {

// The same, with process two on demand: a pushes to c, and c sends to e, whose process four is on demand, too.
graph::Graph with_sleepers() {
  graph::Graph graph = wired_processes();
  graph.processes = {{.name = "two", .on_demand = true}, {.name = "four", .on_demand = true}};
  graph::ComponentNode node;
  node.name = "e";
  node.process = "four";
  graph.components.push_back(node);
  graph.edges.push_back(edge("b", "c"));
  graph.edges.back().pattern = Pattern::send;
  graph.edges.push_back(edge("c", "e"));
  graph.edges.back().pattern = Pattern::query;
  for (graph::Edge& one : graph.edges) one.link = graph::Link::shm;
  return graph;
}

const EdgeMemory& memory_of(const Wiring::Lots& lots, const std::string& process, const std::string& edge) {
  for (const EdgeMemory& memory : lots.by_process.at(process))
    if (memory.edge == edge) return memory;
  throw std::runtime_error("no memory of edge " + edge + " for " + process);
}

// Writes what a client would: the position behind its first record stands first in the memory.
void write_as_client(const EdgeMemory& memory) {
  const auto mapped = SharedMemory::map(memory.memory.number());
  REQUIRE(mapped);
  mapped->bytes()[0] = std::byte{8};
}

bool has_written(const EdgeMemory& memory) {
  const auto mapped = SharedMemory::map(memory.memory.number());
  return mapped && mapped->bytes()[0] == std::byte{8};
}

}  // namespace

TEST_CASE("what a client has written waits for a process on demand, and is found there",
          "[supervisor][wiring][on_demand]") {
  Wiring wiring(with_sleepers());
  const auto lots = wiring.deal({"one", "three"});
  REQUIRE(lots);
  CHECK(wiring.traffic_to("two") == 0);
  write_as_client(memory_of(*lots, "one", "b.out to c.in"));
  CHECK(wiring.traffic_to("two") == 8);
  CHECK(wiring.traffic_to("four") == 0);
  const auto woken = wiring.deal({"two"}, {"two"});
  REQUIRE(woken);
  CHECK(has_written(memory_of(*woken, "two", "b.out to c.in")));
  CHECK_FALSE(woken->by_process.contains("one"));  // it has its end
  CHECK(edges_of(*woken, "two") ==
        std::vector<std::string>{"a.out to c.in", "b.out to c.in", "c.out to e.in"});
}

TEST_CASE("a process on demand that wakes has the pool that its peers know",
          "[supervisor][wiring][on_demand]") {
  Wiring wiring(with_sleepers());
  const auto lots = wiring.deal({"one", "three"});
  REQUIRE(lots);
  const auto woken = wiring.deal({"two"}, {"two"});
  REQUIRE(woken);
  CHECK(file_of(woken->pools.at("two")) == file_of(memory_of(*lots, "one", "a.out to c.in").pool));
  const auto asleep = wiring.deal({"two"});
  REQUIRE(asleep);
  CHECK(file_of(asleep->pools.at("two")) != file_of(woken->pools.at("two")));
}

TEST_CASE("what a process on demand writes as a client of another process does not wake it",
          "[supervisor][wiring][on_demand]") {
  Wiring wiring(with_sleepers());
  const auto lots = wiring.deal({"one"});
  REQUIRE(lots);
  write_as_client(memory_of(*lots, "one", "a.out to c.in"));  // an edge on which two is the client
  CHECK(wiring.traffic_to("two") == 0);
}

TEST_CASE("two processes on demand can wake each other", "[supervisor][wiring][on_demand]") {
  Wiring wiring(with_sleepers());
  REQUIRE(wiring.deal({"one"}));
  const auto two = wiring.deal({"two"}, {"two"});
  REQUIRE(two);
  write_as_client(memory_of(*two, "two", "c.out to e.in"));
  CHECK(wiring.traffic_to("four") == 8);
  const auto four = wiring.deal({"four"}, {"four"});
  REQUIRE(four);
  CHECK(has_written(memory_of(*four, "four", "c.out to e.in")));
}

TEST_CASE("after the end of either process its edges are fresh again", "[supervisor][wiring][on_demand]") {
  Wiring wiring(with_sleepers());
  const auto first = wiring.deal({"one"});
  REQUIRE(first);
  write_as_client(memory_of(*first, "one", "b.out to c.in"));
  const auto restarted = GENERATE(as<std::string>{}, "one", "two");
  const auto second = wiring.deal({restarted});
  REQUIRE(second);
  CHECK(wiring.traffic_to("two") == 0);
  CHECK_FALSE(has_written(memory_of(*second, "one", "b.out to c.in")));
  const auto woken = wiring.deal({"two"}, {"two"});
  REQUIRE(woken);
  CHECK_FALSE(has_written(memory_of(*woken, "two", "b.out to c.in")));
}

TEST_CASE("a process on demand that starts together with a neighbour gets what both share",
          "[supervisor][wiring][on_demand]") {
  Wiring wiring(with_sleepers());
  REQUIRE(wiring.deal({"one"}));
  const auto lots = wiring.deal({"one", "two"}, {"two"});
  REQUIRE(lots);
  write_as_client(memory_of(*lots, "one", "b.out to c.in"));
  CHECK(has_written(memory_of(*lots, "two", "b.out to c.in")));
}
