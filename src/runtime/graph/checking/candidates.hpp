// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "model.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Reports candidates that are a trading query, and returns false for them.
bool candidates_are_names(const LateBinding& late, Report& report);

// Returns the <connect> that a candidate stands for; nothing after a report. `name` is component.port, or a
// component alone if only one of its ports fits.
std::optional<Node> candidate_connection(const CheckedComponent& component, const LateBinding& late,
                                         const std::string& name, const Model& model, Report& report);

}  // namespace orca::graph
