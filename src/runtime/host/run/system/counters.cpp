// SPDX-License-Identifier: LGPL-3.0-or-later
#include "counters.hpp"

namespace orca::host {
namespace {

// Adds the Push edge that ends at a port.
void add_edge(const graph::Edge& node, const PushClientEndpoint& to, RunCounters& counters) {
  if (const auto counted = to.counters_from(node.from.text()))
    counters.edges.push_back({node.from.text(), to.path(), *counted});
}

void add_client(const Endpoint& port, RunCounters& counters) {
  if (const auto* sender = dynamic_cast<const SendClientEndpoint*>(&port))
    counters.clients[port.path()] = sender->counters();
  if (const auto* asker = dynamic_cast<const QueryClientEndpoint*>(&port))
    counters.clients[port.path()] = asker->counters();
}

void add_server(const Endpoint& port, RunCounters& counters) {
  if (const auto* taker = dynamic_cast<const SendServerEndpoint*>(&port))
    counters.servers[port.path()] = taker->counters();
  if (const auto* answerer = dynamic_cast<const QueryServerEndpoint*>(&port))
    counters.servers[port.path()] = answerer->counters();
}

}  // namespace

RunCounters collect_counters(const graph::Graph& graph, const System& system) {
  RunCounters counters;
  for (const graph::Edge& edge : graph.edges) {
    const Endpoint* const from = system.endpoint(edge.from);
    const Endpoint* const to = system.endpoint(edge.to);
    if (const auto* subscriber = dynamic_cast<const PushClientEndpoint*>(to))
      add_edge(edge, *subscriber, counters);
    if (from != nullptr) add_client(*from, counters);
    if (to != nullptr) add_server(*to, counters);
  }
  return counters;
}

}  // namespace orca::host
