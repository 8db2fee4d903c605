// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/geometry/vec2.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// Returns the radius [m] of a part that looks round from above and is centred on the upright axis through
// `center`. Returns a negative number for any other part.
[[nodiscard]] double round_radius(const Part& part, Vec2 center);

}  // namespace orca::sim::detail
