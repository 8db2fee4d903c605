// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "orca/navigation/footprint.hpp"
#include "orca/navigation/known_map.hpp"
#include "orca/navigation/reeds_shepp.hpp"

namespace orca::test {

/// Returns whether a rectangle and a square cell have a point in common: no axis of either separates them. It is written without a look at the
/// planner's own test, to judge it.
inline bool overlaps(const nav::Footprint& body, const Pose2& pose, Vec2 middle, double side) {
  const Vec2 ahead = direction(pose.yaw);
  const Vec2 left{-ahead.y, ahead.x};
  const Vec2 off = middle - pose.position();
  const double half = 0.5 * side;
  const auto separates = [&](Vec2 axis) {
    const double of_body =
        body.half_length * std::fabs(dot(axis, ahead)) + body.half_width * std::fabs(dot(axis, left));
    const double of_cell = half * (std::fabs(axis.x) + std::fabs(axis.y));
    return std::fabs(dot(axis, off)) > of_body + of_cell;
  };
  const std::array<Vec2, 4> axes{Vec2{1.0, 0.0}, Vec2{0.0, 1.0}, ahead, left};
  return std::ranges::none_of(axes, separates);
}

/// Returns whether a rectangle at a pose has a point in common with an occupied cell.
inline bool touches(const nav::FloorGrid& grid, const nav::Footprint& body, const Pose2& pose) {
  const double reach = body.outer_radius();
  const nav::Cell low = grid.lattice.cell_at(pose.position() - Vec2{reach, reach});
  const nav::Cell high = grid.lattice.cell_at(pose.position() + Vec2{reach, reach});
  for (int row = low.row; row <= high.row; ++row)
    for (int column = low.column; column <= high.column; ++column)
      if (grid.occupied({column, row}) &&
          overlaps(body, pose, grid.lattice.middle_of({column, row}), grid.lattice.side))
        return true;
  return false;
}

/// Returns the poses on a way, every `step` [m] and at the end of each piece.
inline std::vector<Pose2> poses_on(Pose2 pose, const std::vector<nav::WayPiece>& way, double step) {
  std::vector<Pose2> poses{pose};
  for (const nav::WayPiece& piece : way) {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(piece.length) / step)));
    for (int i = 1; i <= steps; ++i)
      poses.push_back(nav::driven(pose, piece, piece.length * static_cast<double>(i) / steps));
    pose = poses.back();
  }
  return poses;
}

}  // namespace orca::test
