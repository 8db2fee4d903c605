// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/sim/mesh.hpp"

namespace orca::sim::detail {

// Returns the corners of the convex hull of a mesh, ordered by their coordinates.
[[nodiscard]] std::vector<Vec3> hull_corners(const Mesh& mesh);

}  // namespace orca::sim::detail
