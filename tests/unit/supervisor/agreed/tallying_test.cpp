// SPDX-License-Identifier: GPL-3.0-or-later
#include "agreed/tallying.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::supervisor;

namespace {

graph::Graph two_edges() {
  graph::Graph graph;
  for (const auto& [from, to] : {std::pair("a", "b"), {"c", "d"}}) {
    graph::Edge& edge = graph.edges.emplace_back();
    edge.from = {from, "out"};
    edge.to = {to, "in"};
  }
  return graph;
}

host::RunCounters counted() {
  host::RunCounters counters;
  host::RunCounters::Edge& edge = counters.edges.emplace_back();
  edge.from = "c.out";
  edge.to = "d.in";
  edge.counters.delivered = 7;
  edge.counters.missed_deadlines = 3;
  edge.counters.queued = 1;
  edge.counters.high_water = 5;
  counters.clients["c.ask"].sent = 4;
  counters.clients["c.ask"].timed_out = 2;
  counters.servers["d.take"].accepted = 9;
  counters.servers["d.take"].high_water = 8;
  return counters;
}

}  // namespace

TEST_CASE("counters arrive as they were, edges in the order of the graph", "[supervisor][tally]") {
  host::RunCounters other;
  other.edges.push_back({"a.out", "b.in", {}});
  other.edges.back().counters.dropped = 6;
  const std::map<std::string, Tally> tallies{{"base", to_tally(counted(), {})},
                                             {"main", to_tally(other, {})}};
  const host::RunCounters read = counters_of(two_edges(), tallies);
  REQUIRE(read.edges.size() == 2);
  CHECK(read.edges[0].from == "a.out");
  CHECK(read.edges[0].counters.dropped == 6);
  CHECK(read.edges[1].counters.delivered == 7);
  CHECK(read.edges[1].counters.missed_deadlines == 3);
  CHECK(read.edges[1].counters.queued == 1);
  CHECK(read.edges[1].counters.high_water == 5);
  CHECK(read.clients.at("c.ask").sent == 4);
  CHECK(read.clients.at("c.ask").timed_out == 2);
  CHECK(read.servers.at("d.take").accepted == 9);
  CHECK(read.servers.at("d.take").high_water == 8);
}

TEST_CASE("a process that sends too few numbers, or edges that are not there, does no harm",
          "[supervisor][tally]") {
  Tally tally;
  tally.edges = {{"a.out to b.in", {1}}, {"x.out to y.in", {1}}, {"c.out to d.in", {}}};
  tally.ways = {{"base", {}}};
  const host::RunCounters read = counters_of(two_edges(), {{"main", tally}});
  REQUIRE(read.edges.size() == 2);
  CHECK(read.edges[0].counters.delivered == 1);
  CHECK(read.edges[1].counters.delivered == 0);
  CHECK(ways_of({{"main", tally}}).at(0).length == 0.0);
}

TEST_CASE("of the ways that several processes tell of a robot the longest counts", "[supervisor][tally]") {
  const auto ways = ways_of({{"a", to_tally({}, {{"base", 1.5}})}, {"b", to_tally({}, {{"base", 2.25}})}});
  REQUIRE(ways.size() == 1);
  CHECK(ways[0].robot == "base");
  CHECK(ways[0].length == Approx(2.25));
}

TEST_CASE("what processes show is put together", "[supervisor][tally]") {
  host::RunGlance shown;
  shown.unwell = {{"scout", "Fault"}};
  shown.goals = {{"kitchen", 2.5}};
  host::RunGlance glance;
  add(to_report(shown), glance);
  REQUIRE(glance.unwell.size() == 1);
  CHECK(glance.unwell[0].state == "Fault");
  REQUIRE(glance.goals.size() == 1);
  CHECK(glance.goals[0].name == "kitchen");
  CHECK(glance.goals[0].distance == Approx(2.5));
}

TEST_CASE("what a process has counted in several lives is added up", "[supervisor][tally][on_demand]") {
  Tally sum;
  for (int life = 0; life < 3; ++life) add(to_tally(counted(), {{"base", 2.5}}), sum);
  const host::RunCounters read = counters_of(two_edges(), {{"base", sum}});
  REQUIRE(read.edges.size() == 1);
  CHECK(read.edges[0].counters.delivered == 21);
  CHECK(read.edges[0].counters.high_water == 5);
  CHECK(read.clients.at("c.ask").sent == 12);
  CHECK(read.servers.at("d.take").accepted == 27);
  REQUIRE(ways_of({{"base", sum}}).size() == 1);
  CHECK(ways_of({{"base", sum}})[0].length == Approx(7.5));
  Tally other;
  other.edges.push_back({"an edge of another graph", {1, 2, 3}});
  add(other, sum);
  CHECK(sum.edges.size() == 2);
  CHECK(counters_of(two_edges(), {{"base", sum}}).edges.size() == 1);
}
