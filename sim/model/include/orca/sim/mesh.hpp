// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/robots/characteristics.hpp"
#include "orca/sim/shape.hpp"

namespace orca::sim {

using robots::Vec3;

/// Three corners, counter-clockwise when seen from outside.
using Triangle = std::array<Vec3, 3>;

/// The surface of solids as triangles. A point is inside if the number of crossings is odd, so the surface
/// should be closed; a cast sees an open one as it is. A plain value.
struct Mesh {
  std::vector<Triangle> triangles;
};

/// Reads an STL file, binary or text, or an OBJ file, distinguished by the ending. OBJ faces with more than
/// three corners become fans. Triangles without area are left out.
///
/// @errors  not_found: no such file. data_loss: it is damaged, with the line or byte.
///          invalid_argument: another ending; no face; more than 1,000,000 faces; a corner that is not finite
///          or beyond 100 km.
[[nodiscard]] Result<Mesh> read_mesh(const std::string& path);

/// Returns the mesh scaled along its own axes, then turned by the pose's yaw, moved to it and raised by `z`
/// [m].
[[nodiscard]] Mesh placed(Mesh mesh, const Vec3& scale, const Pose2& X_WM, double z);

/// Returns the heights of the lowest (first) and highest (second) point [m]. @pre  the mesh has triangles.
[[nodiscard]] std::pair<double, double> height_range_of(const Mesh& mesh);

/// Returns the convex hull of the mesh seen from above.
[[nodiscard]] Outline plan_of(const Mesh& mesh);

/// Returns the exact section with the horizontal plane at `height` [m]. Points in the plane count as below
/// it, so that a solid is cut where bottom <= height < top.
[[nodiscard]] Outline section_of(const Mesh& mesh, double height);

/// Returns true if the upright body over `plan` between `bottom` and `top` [m] shares a point with the mesh.
[[nodiscard]] bool overlap(const Mesh& mesh, const Shape& plan, double bottom, double top);

}  // namespace orca::sim
