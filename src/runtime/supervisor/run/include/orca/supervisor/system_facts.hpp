// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/port_list.hpp"
#include "orca/host/catalogue.hpp"

namespace orca::supervisor {

/// The plugin of a type of component or hardware.
struct PluginFacts {
  std::string file;
  std::string build_id;  ///< PluginLibrary::build_id().
};

/// What an operator may ask about a system and the graph does not tell, from its plugins.
struct SystemFacts {
  std::vector<graph::ListedPort> ports;        ///< Of all components.
  std::map<std::string, Contract> contracts;   ///< By component.
  std::map<std::string, Contract> drivers;     ///< By hardware; their parameters.
  std::map<std::string, PluginFacts> plugins;  ///< By type.
  std::vector<std::string> plugin_folders;     ///< In the order in which they are searched.
};

/// A graph that was read and checked.
struct CheckedSystem {
  graph::Graph graph;
  SystemFacts facts;
  std::set<std::string> files;  ///< The graph's own file and those that it includes.
};

/// Where a graph is to be read.
struct GraphSource {
  std::string file;                   ///< Or, with a text, its name for people.
  std::optional<std::string> text{};  ///< As graph::print() writes it.
};

/// Reads a graph and checks it as a run of it would; a file with the profiles and settings of the present run.
/// @errors  all that is wrong with it, a line each.
using SystemReader = std::function<Result<CheckedSystem>(const GraphSource& source)>;

/// Returns the facts of a system.
/// @param catalogue  the one that has checked the graph.
[[nodiscard]] SystemFacts facts_of(const graph::Graph& graph, host::PluginCatalogue& catalogue);

/// Returns the build ids of the code that a process runs, by type; without what it loads on demand.
/// @param catalogue  the one that the process was built from.
[[nodiscard]] std::map<std::string, std::string> builds_in(const graph::Graph& graph,
                                                           const std::string& process,
                                                           host::PluginCatalogue& catalogue);

}  // namespace orca::supervisor
