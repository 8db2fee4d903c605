// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/sim/bitmap.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::sim {

/// Reads a world: an XML file (root <world>, docs/world-files.md has the elements), an occupancy bitmap if the
/// name ends in .png or .pgm, or one of the worlds of a .csv or .csv.gz file of cylinders.
///
/// @param path         "FILE" or "FILE#N". N chooses one of the worlds of a CSV file; in an XML world it is
///                     the seed of all generated things.
/// @param scale        scale of a bitmap; needed for bitmaps, an error for all other files.
/// @param diagnostics  receives all errors at once, each with file, line and column (codes W001 ...).
/// @return nothing if there was any error.
[[nodiscard]] std::optional<WorldModel> read_world(const std::string& path, const BitmapScale& scale,
                                                   xml::Diagnostics& diagnostics);

/// Does the same for a caller that shows one text; a bitmap needs a scale and is refused.
/// @param warnings  receives them, one line each, also if there are errors.
/// @errors  invalid_argument with all errors, at most 20 of them.
[[nodiscard]] Result<WorldModel> read_world(const std::string& path, std::vector<std::string>& warnings);

/// Reads a world from XML in memory; `file_name` appears in positions, and bitmaps are searched beside it.
/// @param seed  seed of all generated things, instead of the file's own.
[[nodiscard]] std::optional<WorldModel> read_world_text(std::string_view text, const std::string& file_name,
                                                        xml::Diagnostics& diagnostics,
                                                        std::optional<std::uint64_t> seed = {});

}  // namespace orca::sim
