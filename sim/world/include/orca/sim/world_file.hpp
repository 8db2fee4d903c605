// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "orca/sim/world_model.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::sim {

/// Reads a world: an XML file (root <world>, docs/simulation.md has the elements), or an occupancy bitmap if
/// the name ends in .png or .pgm.
///
/// @param map_width    [m] width of a bitmap; needed for bitmaps, an error for XML.
/// @param diagnostics  receives everything that is wrong at once, each with file, line and column (codes W001
/// ...).
/// @return nothing if there was any error.
[[nodiscard]] std::optional<WorldModel> read_world(const std::string& path, std::optional<double> map_width,
                                                   xml::Diagnostics& diagnostics);

/// The same for XML in memory; `file_name` appears in positions, and bitmaps are searched beside it.
[[nodiscard]] std::optional<WorldModel> read_world_text(std::string_view text, const std::string& file_name,
                                                        xml::Diagnostics& diagnostics);

}  // namespace orca::sim
