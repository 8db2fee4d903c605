// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "model.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// False, after a report, if the candidates are a trading query.
bool candidates_are_names(const LateBinding& late, Report& report);

// The <connect> that a candidate stands for. `name` is a component, if only one of its ports fits, or
// component.port. Nothing after a report.
std::optional<Node> candidate_connection(const CheckedComponent& component, const LateBinding& late,
                                         const std::string& name, const Model& model, Report& report);

}  // namespace orca::graph
