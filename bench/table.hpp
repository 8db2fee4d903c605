// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <vector>

#include "comparison.hpp"

namespace orca::bench {

/// Prints every row that was measured: medians, p99, ratios, and whether targets are met.
/// @return the number of missed targets.
int print_table(std::ostream& out, const std::vector<Row*>& rows);

}  // namespace orca::bench
