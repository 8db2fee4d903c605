// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>

namespace orca::batch {

/// Returns the probability that a variable of Student's t distribution is at least as far from 0 as `t`; NaN of NaN. The
/// absolute error is below 1e-12 up to 5,000 degrees of freedom.
/// @param freedom  degrees of freedom, at least 1. The time grows with it.
/// @source  Abramowitz and Stegun, "Handbook of mathematical functions", 1964, eq. 26.7.3 and 26.7.4.
[[nodiscard]] double two_sided_student_tail(double t, std::size_t freedom);

/// Returns the t >= 0 whose two_sided_student_tail() is `tail`, to a relative error of 1e-12.
/// @param tail  from 1e-6 to 1; 0.05 for an interval of 95 %.
[[nodiscard]] double student_reach(double tail, std::size_t freedom);

}  // namespace orca::batch
