// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/port_list.hpp"
#include "orca/host/catalogue.hpp"

namespace orca::supervisor {

/// The plugin of a type of component or hardware.
struct PluginFacts {
  std::string file;
  std::string build_id;  ///< Of the Orca that it was built with.
};

/// What an operator may ask about a system and the graph does not tell, from its plugins.
struct SystemFacts {
  std::vector<graph::ListedPort> ports;        ///< Of all components.
  std::map<std::string, Contract> contracts;   ///< By component.
  std::map<std::string, PluginFacts> plugins;  ///< By type.
};

/// Returns the facts of a system.
/// @param catalogue  the one that has checked the graph.
[[nodiscard]] SystemFacts facts_of(const graph::Graph& graph, host::PluginCatalogue& catalogue);

}  // namespace orca::supervisor
