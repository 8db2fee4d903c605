// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/plugin/index.hpp"

namespace orca::host {

/// A component type of a plugin, and whether it fits into a place.
struct OfferedCode {
  std::string file;
  std::string type;
  /// Why it cannot take the place; empty: its ports fit.
  std::string misfit;
  /// Whether its code failed when it was asked for its ports, as `misfit` says.
  bool is_broken = false;
};

/// Compares the ports of all component types of plugins with those of a component, as an exchange of its code does. The code of
/// the plugins runs in a copy of this process only, which may crash or hang.
/// @param ports    of the component, by their names in the graph.
/// @param give_up  asked several times a second; true ends it. Empty: never.
/// @return all types, in alphabetical order.
/// @errors  not_found if the graph has no such component; unimplemented if this build cannot copy its process; unavailable if no copy
///          can be made, or if it was given up.
/// @thread  any; the copy has only the calling thread.
[[nodiscard]] Result<std::vector<OfferedCode>> compare_offers(const graph::Graph& graph,
                                                              const std::string& component,
                                                              const std::vector<PortContract>& ports,
                                                              const plugin::PluginIndex& index,
                                                              const std::function<bool()>& give_up);

}  // namespace orca::host
