// SPDX-License-Identifier: GPL-3.0-or-later
#include "starting/starter.hpp"

#include <sys/resource.h>

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::supervisor;

namespace {

graph::Graph two_processes() {
  graph::Graph graph;
  graph.name = "two";
  for (const char* const name : {"one", "two"}) {
    graph::ComponentNode node;
    node.name = name;
    node.process = name;
    graph.components.push_back(node);
    graph.processes.push_back({.name = name});
  }
  graph::Edge edge;
  edge.from = {"one", "out"};
  edge.to = {"two", "in"};
  edge.link = graph::Link::shm;
  graph.edges = {edge};
  return graph;
}

}  // namespace

TEST_CASE("a process that the system has no descriptors for has failed to start, and nothing else happens",
          "[supervisor][starter]") {
  const graph::Graph graph = two_processes();
  const SupervisedOptions options{};
  const RunIdentity run = std::move(begin_run(graph, "")).value();
  Roster roster(graph, "", run.processes);
  const Members& all = roster.all();
  Starter starter(graph, options.facts, options, run, roster);
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{3, before.rlim_max};
  setrlimit(RLIMIT_NOFILE, &none);
  const Starter::Begun begun = starter.start(all);
  setrlimit(RLIMIT_NOFILE, &before);
  CHECK(begun.members.empty());
  REQUIRE(begun.failed.size() == 2);
  CHECK(begun.failed[0].first == all[0]);
  CHECK(begun.failed[0].second.code == Code::unavailable);
  CHECK(all[0]->process() == nullptr);
}
