// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "orca/base/result.hpp"

namespace orca::batch {

/// Reads lengths from a file of comma-separated values, whose first line names the columns.
/// @param column  of the lengths [m]; the worlds' numbers are in the column "world".
/// @return the lengths by number.
/// @errors  not_found if there is no such file or column; invalid_argument with the line for what is no number, or no positive length.
[[nodiscard]] Result<std::map<std::uint64_t, double>> read_references(const std::string& file,
                                                                      const std::string& column);

}  // namespace orca::batch
