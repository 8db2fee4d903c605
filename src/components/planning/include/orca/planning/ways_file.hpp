// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/planning/ways.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::planning {

/// Reads a topological map: places, doors and legs, in the frame of the goals. The README of RouteServer says what its elements mean.
/// @errors  invalid_argument with all that is wrong with the file, each with line and column.
/// @thread  any.
[[nodiscard]] Result<Ways> read_ways(const std::string& file);

/// Does the same for text in memory; `file_name` only appears in positions.
/// @return nothing if the text has an error.
[[nodiscard]] std::optional<Ways> read_ways_text(std::string_view text, const std::string& file_name,
                                                 xml::Diagnostics& diagnostics);

}  // namespace orca::planning
