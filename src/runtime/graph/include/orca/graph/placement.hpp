// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/graph/graph.hpp"

namespace orca::graph {

/// The parts of a graph that belong to one process, each in the order of the graph.
struct ProcessPart {
  std::vector<std::string> components;
  std::vector<std::string> hardware;
  // Indices into Graph::edges.
  std::vector<std::size_t> edges_within;  ///< Both ends are in the process.
  std::vector<std::size_t> edges_out;     ///< Only the `from` end is.
  std::vector<std::size_t> edges_in;      ///< Only the `to` end is.
};

/// Returns the processes in which something runs: those that the graph declares, in its order, then "main" with
/// the default settings if parts are in it and the graph does not declare it.
/// @thread  pure function; any thread. So are the others.
[[nodiscard]] std::vector<ProcessNode> processes_of(const Graph& graph);

/// Returns those of them that run on a machine.
/// @param machine  empty: the graph declares no machines, so all of them do.
[[nodiscard]] std::vector<ProcessNode> processes_on(const Graph& graph, const std::string& machine);

/// Returns whether a process is started only when something in it is needed.
[[nodiscard]] bool starts_on_demand(const Graph& graph, const std::string& process);

/// Returns what runs in the process of that name, and the edges at its components.
[[nodiscard]] ProcessPart part_of(const Graph& graph, const std::string& process);

/// Returns whether a process has an edge that goes over DDS.
[[nodiscard]] bool speaks_dds(const Graph& graph, const std::string& process);

/// Returns whether the graph runs on several machines, each of which then has a process that speaks with the others.
[[nodiscard]] inline bool has_neighbours(const Graph& graph) { return graph.machines.size() >= 2; }

/// Returns the graph with only what runs in the process of that name, and the edges within it.
[[nodiscard]] Graph subgraph(const Graph& graph, const std::string& process);

/// Returns the graph with only what runs on that machine, the edges within it, and those ends that are on it.
/// @param machine  empty: the graph declares no machines, so everything runs on it.
[[nodiscard]] Graph part_on(const Graph& graph, const std::string& machine);

/// Returns the machine on which a component runs; empty: the graph declares no machines.
/// @pre  the graph has the component.
[[nodiscard]] std::string machine_of(const Graph& graph, const std::string& component);

/// Returns how long each object on an edge is under way in virtual time [s], each way: between two processes the sum of their delays, and
/// between two machines that of theirs in addition.
/// @pre  the graph has the components of both ends.
[[nodiscard]] Duration delay_of(const Graph& graph, const Edge& edge);

/// Returns the names of all components in the order in which they come up: each after those that its start_after
/// names, otherwise as in the graph.
/// @pre  the graph was checked: start_after names components and goes in no circle.
[[nodiscard]] std::vector<std::string> start_order(const Graph& graph);

}  // namespace orca::graph
