// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"

namespace orca::graph {

/// Reads new values for some of a component's parameters as a graph would, for a change at run time.
///
/// @param texts  values by name: "0.5 m", "true", ...
/// @errors  invalid_argument with everything that is wrong, one line each.
[[nodiscard]] Result<Params> read_settings(const std::vector<ParamContract>& contracts,
                                           const std::map<std::string, std::string>& texts);

}  // namespace orca::graph
