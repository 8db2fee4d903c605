// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "model.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Returns the names of the candidates, of which some may be found by what they must be like; nothing after a report.
std::optional<std::vector<std::string>> candidate_names(const CheckedComponent& component,
                                                        const LateBinding& late, const Model& model,
                                                        Report& report);

// Returns the <connect> that a candidate stands for; nothing after a report. `name` is component.port, or a
// component alone if only one of its ports fits.
std::optional<Node> candidate_connection(const CheckedComponent& component, const LateBinding& late,
                                         const std::string& name, const Model& model, Report& report);

}  // namespace orca::graph
