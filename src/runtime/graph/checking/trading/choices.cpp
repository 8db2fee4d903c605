// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/wiring.hpp"

#include <string>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"

namespace orca::graph {

bool Choices::add(const Edge& edge, const Endpoint& proxy) {
  std::vector<Edge>& others = edges_[proxy.ref];
  if (!add_to(others, edge, proxy)) return false;
  others.push_back(edge);
  return true;
}

bool Choices::add_to(const std::vector<Edge>& others, const Edge& edge, const Endpoint& proxy) {
  for (const Edge& other : others) {
    if (edge.choice == 0 || other.choice == 0)
      return refuse(codes::kTooManyEdges, edge, proxy, other, "takes one connection and gets two");
    if (edge.choice == other.choice)
      return refuse(codes::kTooManyEdges, edge, proxy, other,
                    "gets two connections with choice=\"" + std::to_string(edge.choice) + "\"");
    if (edge.queue != other.queue || edge.interval != other.interval)
      return refuse(codes::kPolicy, edge, proxy, other,
                    "gets two connections to choose from that differ in their policy");
  }
  return true;
}

bool Choices::refuse(const char* code, const Edge& edge, const Endpoint& proxy, const Edge& other,
                     const std::string& what) {
  report_.error(code, edge.position,
                described(proxy) + " " + what + ": from " + in_quotes(edge.from.text()) + " to " +
                    in_quotes(edge.to.text()) + " here, from " + in_quotes(other.from.text()) + " to " +
                    in_quotes(other.to.text()) + " at " + other.position.text());
  return false;
}

}  // namespace orca::graph
