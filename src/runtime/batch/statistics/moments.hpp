// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

namespace orca::batch {

/// Returns quantile() of values in ascending order.
/// @pre  at least one value, all finite; q in [0, 1]
[[nodiscard]] double quantile_of_sorted(std::span<const double> sorted, double q);

/// Returns mean() of the values.
/// @pre  at least one value
[[nodiscard]] double mean_of(std::span<const double> values);

/// Returns the standard error of mean_of(), from the spread of the values; exactly 0 if they are equal.
/// @pre  at least two values
[[nodiscard]] double standard_error_of(std::span<const double> values);

}  // namespace orca::batch
