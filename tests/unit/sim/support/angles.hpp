// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace orca::sim::test {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kDegree = kPi / 180.0;  // [rad]

}  // namespace orca::sim::test
