// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>

#include "orca/geometry/vec2.hpp"

namespace orca::sim::detail {

inline float single(double value) { return static_cast<float>(value); }

// Returns a generous bound [m] on the rounding error of single precision near a place. A search that allows
// for it finds too many things rather than too few.
inline double single_margin(Vec2 place) { return 1e-3 + 1e-6 * (std::fabs(place.x) + std::fabs(place.y)); }

}  // namespace orca::sim::detail
