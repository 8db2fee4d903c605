// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/edge_choice.hpp"

#include <algorithm>
#include <map>

namespace orca::host {
namespace {

std::string text_of(const graph::Edge& before, const std::string& why, const graph::Edge& after) {
  return after.client().port + " uses " + after.server().text() + " from now on, because " +
         before.server().component + " " + why;
}

}  // namespace

Standing standing_of(const ComponentReport& report) {
  const bool is_lost = report.state == ComponentState::unloaded && !report.failure.empty();
  if (is_lost || report.ended_badly || is_failed(report.state)) return {false, "is down: " + report.failure};
  if (report.state == ComponentState::exit) return {false, "has ended"};
  return {report.state != ComponentState::init};
}

EdgeChoice::EdgeChoice(const graph::Graph& graph) {
  std::map<graph::PortRef, std::size_t> places;
  for (const graph::Edge& edge : graph.edges) {
    if (edge.choice == 0) continue;
    const auto [place, is_new] = places.try_emplace(edge.client(), ports_.size());
    if (is_new) ports_.emplace_back();
    ports_[place->second].edges.push_back(edge);
  }
  for (Port& port : ports_) std::ranges::sort(port.edges, {}, &graph::Edge::choice);
}

std::vector<EdgeChoice::Move> EdgeChoice::look(const Standings& standings) {
  std::vector<Move> moves;
  for (Port& port : ports_) {
    const graph::Edge& used = port.edges[port.used];
    const std::string why = standings(used.server().component).why_down;
    if (why.empty()) continue;
    const auto better = std::ranges::find_if(
        port.edges, [&](const graph::Edge& edge) { return standings(edge.server().component).is_up; });
    if (better == port.edges.end()) continue;
    port.used = static_cast<std::size_t>(better - port.edges.begin());
    moves.push_back({&*better, text_of(used, why, *better)});
  }
  return moves;
}

std::vector<const graph::Edge*> EdgeChoice::in_use() const {
  std::vector<const graph::Edge*> edges;
  for (const Port& port : ports_) edges.push_back(&port.edges[port.used]);
  return edges;
}

}  // namespace orca::host
