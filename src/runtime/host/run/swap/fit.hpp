// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "run/component/parts/component_settings.hpp"
#include "run/component/parts/parameters.hpp"
#include "run/hardware/hardware_instance.hpp"

namespace orca::host {

/// Returns why a type cannot take a component's place in a running system, one difference each; empty if it can.
/// @param present    ports of the component, by their names in the graph.
/// @param connected  names of those that have a connection.
/// @param offered    ports of the type, by those names.
[[nodiscard]] std::vector<std::string> misfits(const std::vector<PortContract>& present,
                                               const std::set<std::string>& connected,
                                               const std::vector<PortContract>& offered);

/// Does the same for a component of a graph.
/// @param settings  of the component.
/// @param offered   ports of the type, by its author's names.
[[nodiscard]] std::vector<std::string> misfits_in(const graph::Graph& graph,
                                                  const ComponentSettings& settings,
                                                  const std::vector<PortContract>& present,
                                                  const std::vector<PortContract>& offered);

/// Returns the parameters of an object that takes another one's place: those that it shares with the old one keep
/// their values, others have their defaults.
/// @param values  of the old one.
/// @param given   new values, as written in a graph, which replace those.
/// @errors  invalid_argument with all values that are out of the new one's range or of another type, or what is wrong with
///          those given.
[[nodiscard]] Result<ParamValues> inherited(const std::vector<ParamContract>& offered, ParamValues values,
                                            const std::map<std::string, std::string>& given);

/// Returns why a driver cannot take the present one's place under its servers, one difference each; empty if it can. It
/// must have the same sensors with the same periods, the same kind of base, and every device that the present one describes.
/// It may have more.
/// @pre  both were constructed.
[[nodiscard]] std::vector<std::string> driver_misfits(HardwareInstance& present, HardwareInstance& offered);

}  // namespace orca::host
