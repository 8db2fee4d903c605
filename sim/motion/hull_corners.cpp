// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hull_corners.hpp"

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <tuple>

namespace orca::sim::detail {

std::vector<Vec3> hull_corners(const Mesh& mesh) {
  std::vector<Vec3> points;
  for (const Triangle& t : mesh.triangles) points.insert(points.end(), t.begin(), t.end());
  const auto key = [](const Vec3& p) { return std::tuple(p.x, p.y, p.z); };
  std::ranges::sort(points, {}, key);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  btConvexHullComputer computer;
  computer.compute(&points.front().x, sizeof(Vec3), static_cast<int>(points.size()), 0, 0);
  std::vector<Vec3> corners;
  for (int i = 0; i < computer.vertices.size(); ++i) {
    const btVector3& p = computer.vertices[i];
    corners.push_back({p.x(), p.y(), p.z()});
  }
  std::ranges::sort(corners, {}, key);
  return corners;
}

}  // namespace orca::sim::detail
