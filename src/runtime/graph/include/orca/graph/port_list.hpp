// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "orca/graph/catalogue.hpp"
#include "orca/graph/graph.hpp"

namespace orca::graph {

/// Returns a port for people: "PushServer of RangeReadings".
[[nodiscard]] std::string described(const PortContract& port);

/// The other end of a connection.
struct ListedPeer {
  PortRef ref;
  Link link = Link::local;   ///< What carries the objects.
  std::uint32_t choice = 0;  ///< Rank among those of which the proxy uses one at a time; 0: it uses all.
  bool in_use = false;       ///< Of those, the one that it uses at present, if the system runs.
};

/// A port of a component of a graph, and the ports at its other end.
struct ListedPort {
  PortRef ref;            ///< By its name in the graph.
  PortContract contract;  ///< As its author declares it.
  bool disabled = false;
  std::vector<ListedPeer> peers;    ///< Ports connected to it, in the order of the graph.
  std::vector<PortRef> candidates;  ///< Ports that it may be connected to at run time.
  std::string process{};            ///< Of its component.
  std::string topic{};              ///< Of ROS 2, on which it speaks as well; empty: none.
  std::string team{};               ///< What it offers to the team or hears from it; empty: nothing.
};

/// Returns all ports of all components of a checked graph, in its order.
/// @param catalogue  the catalogue that the graph was checked against.
[[nodiscard]] std::vector<ListedPort> list_ports(const Graph& graph, Catalogue& catalogue);

/// Marks the choices that are in use.
/// @param edges  those of a running system's graph that are, of all that have a choice.
void mark_in_use(std::vector<ListedPort>& ports, const std::vector<const Edge*>& edges);

/// Returns one line per port, in columns: name, pattern and role, type, connected ports with the link between
/// processes.
[[nodiscard]] std::string ports_text(const std::vector<ListedPort>& ports);

/// Returns the same for programs: an array of {port, declared_as, process, pattern, role, type, reply, required,
/// many, disabled, connected_to, links, choices, in_use, candidates, text}; links, choices and in_use have one for each
/// port of connected_to.
[[nodiscard]] std::string ports_json(const std::vector<ListedPort>& ports);

}  // namespace orca::graph
