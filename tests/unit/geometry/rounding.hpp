// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace orca::test {

inline constexpr double kPi = std::numbers::pi;

/// Largest rounding error of positions of metres and of angles, in a handful of operations.
inline constexpr double kRounding = 1e-13;

}  // namespace orca::test
