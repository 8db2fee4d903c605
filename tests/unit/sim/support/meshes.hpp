// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "orca/base/random.hpp"
#include "orca/sim/mesh.hpp"

namespace orca::sim::test {

/// A box around the origin of the plane, from z = 0 up, as twelve triangles.
inline Mesh box_mesh(double length, double width, double height) {
  const auto corner = [&](int i) {
    return Vec3{(i & 1 ? 0.5 : -0.5) * length, (i & 2 ? 0.5 : -0.5) * width, i & 4 ? height : 0.0};
  };
  constexpr int kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  Mesh mesh;
  for (const auto& f : kFaces) {
    mesh.triangles.push_back({corner(f[0]), corner(f[1]), corner(f[2])});
    mesh.triangles.push_back({corner(f[0]), corner(f[2]), corner(f[3])});
  }
  return mesh;
}

/// A closed, bumpy body about `center`, of 2 * 10 * 7 triangles: a sphere whose radius differs at each
/// corner.
inline Mesh boulder(RandomStream& random, const Vec3& center, double radius) {
  constexpr int kAround = 10;
  constexpr int kRings = 7;
  const auto at = [&](double elevation, double azimuth) {
    const double r = radius * random.uniform(0.6, 1.0);
    return Vec3{center.x + r * std::cos(elevation) * std::cos(azimuth),
                center.y + r * std::cos(elevation) * std::sin(azimuth), center.z + r * std::sin(elevation)};
  };
  std::vector<std::vector<Vec3>> rings;
  for (int i = 0; i < kRings; ++i)
    for (int k = 0; k < kAround; ++k) {
      if (k == 0) rings.emplace_back();
      rings.back().push_back(
          at(std::numbers::pi * ((i + 1.0) / (kRings + 1) - 0.5), 2.0 * std::numbers::pi * k / kAround));
    }
  const Vec3 bottom = at(-0.5 * std::numbers::pi, 0.0);
  const Vec3 top = at(0.5 * std::numbers::pi, 0.0);
  Mesh mesh;
  for (std::size_t k = 0; k < kAround; ++k) {
    const std::size_t next = (k + 1) % kAround;
    mesh.triangles.push_back({bottom, rings.front()[next], rings.front()[k]});
    mesh.triangles.push_back({top, rings.back()[k], rings.back()[next]});
    for (std::size_t i = 0; i + 1 < kRings; ++i) {
      mesh.triangles.push_back({rings[i][k], rings[i][next], rings[i + 1][next]});
      mesh.triangles.push_back({rings[i][k], rings[i + 1][next], rings[i + 1][k]});
    }
  }
  return mesh;
}

}  // namespace orca::sim::test
