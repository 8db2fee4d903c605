// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::batch {

/// Returns the complementary error function for x >= 0, with a relative error below 1e-13 up to x = 26; NaN of NaN. It uses
/// basic operations and portable::exp() only.
/// @source  Abramowitz and Stegun, "Handbook of mathematical functions", 1964, eq. 7.1.6 (series) and 7.1.14 (continued fraction).
[[nodiscard]] double erfc_of_positive(double x);

/// Returns the probability that a standard normal variable is at least as far from 0 as `z`.
[[nodiscard]] double two_sided_normal_tail(double z);

}  // namespace orca::batch
