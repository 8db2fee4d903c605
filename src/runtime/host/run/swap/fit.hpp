// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "run/component/parameters.hpp"

namespace orca::host {

/// Returns why a type cannot take a component's place in a running system, one difference each; empty if it can.
/// @param present    ports of the component, by their names in the graph.
/// @param connected  names of those that have a connection.
/// @param offered    ports of the type, by those names.
[[nodiscard]] std::vector<std::string> misfits(const std::vector<PortContract>& present,
                                               const std::set<std::string>& connected,
                                               const std::vector<PortContract>& offered);

/// Returns the parameters of an object that takes another one's place: those that it shares with the old one keep
/// their values, others have their defaults.
/// @param values  of the old one.
/// @errors  invalid_argument with all values that are out of the new one's range or of another type.
[[nodiscard]] Result<ParamValues> inherited(const std::vector<ParamContract>& offered,
                                            const ParamValues& values);

}  // namespace orca::host
