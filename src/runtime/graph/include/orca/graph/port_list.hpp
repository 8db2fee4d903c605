// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/graph/catalogue.hpp"
#include "orca/graph/graph.hpp"

namespace orca::graph {

/// The other end of a connection.
struct ListedPeer {
  PortRef ref;
  Link link = Link::local;  ///< What carries the objects.
};

/// A port of a component of a graph, and the ports at its other end.
struct ListedPort {
  PortRef ref;            ///< By its name in the graph.
  PortContract contract;  ///< As its author declares it.
  bool disabled = false;
  std::vector<ListedPeer> peers;    ///< Ports connected to it, in the order of the graph.
  std::vector<PortRef> candidates;  ///< Ports that it may be connected to at run time.
  std::string process{};            ///< Of its component.
};

/// Returns all ports of all components of a checked graph, in its order.
/// @param catalogue  the catalogue that the graph was checked against.
[[nodiscard]] std::vector<ListedPort> list_ports(const Graph& graph, Catalogue& catalogue);

/// Returns one line per port, in columns: name, pattern and role, type, connected ports with the link between
/// processes.
[[nodiscard]] std::string ports_text(const std::vector<ListedPort>& ports);

/// Returns the same for programs: an array of {port, declared_as, process, pattern, role, type, reply, required,
/// many, disabled, connected_to, links, candidates, text}; links has one for each port of connected_to.
[[nodiscard]] std::string ports_json(const std::vector<ListedPort>& ports);

}  // namespace orca::graph
