// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/patterns/endpoints/cores.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "run/component/component_instance.hpp"

namespace orca::host {

/// Returns what the graph sets for a component, and how the run's options make it fail.
[[nodiscard]] ComponentSettings settings_of(const graph::ComponentNode& node,
                                            const std::vector<PlannedFailure>& failures = {});

/// Returns the cores that the components of a process share, which are made when they are first asked for; null: each lap has a core
/// of its own.
/// @param cores  by process.
[[nodiscard]] Cores* cores_of(const graph::Graph& graph, const std::string& process,
                              std::map<std::string, Cores>& cores);

/// Makes the ports of a component that is loaded on demand. They exist from the start.
/// @errors  those of the catalogue.
Status declare(const graph::Graph& graph, const graph::ComponentNode& node, ComponentInstance& instance,
               PluginCatalogue& catalogue);

/// Returns the links for an edge within this process: in virtual time, objects are under way on them as long as the graph says.
[[nodiscard]] LocalLinks links_of(const graph::Graph& graph, const graph::Edge& edge, RunContext& run);

/// Returns the whole policy of an edge.
[[nodiscard]] QueuePolicy policy_of(const graph::Edge& edge);

/// Connects the ports of a graph's components.
/// @param find      returns a component by name.
/// @param links_of  returns the links for an edge.
/// @errors  internal if a port is not there; those of the links.
Status connect(const graph::Graph& graph, const std::function<ComponentInstance*(const std::string&)>& find,
               const std::function<LocalLinks(const graph::Edge&)>& links_of);

/// Lets the port at an edge move if the graph gives it several edges to choose from.
/// @pre  the edge is not connected yet.
void prepare_choice(const graph::Edge& edge, Endpoint& client);
/// Moves the port to the edge if that is the first of several that it chooses from.
/// @pre  the edge is connected.
void take_first_choice(const graph::Edge& edge, Endpoint& client);

/// Waits until `done` holds, and evaluates it each time something changes.
/// @return false if it does not hold at the deadline.
bool wait_until_holds(Executive& executive, Event& changed, TimePoint deadline,
                      const std::function<bool()>& done);

}  // namespace orca::host
