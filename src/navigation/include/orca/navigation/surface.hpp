// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/lattice.hpp"

namespace orca::nav {

/// A point of a surface as a scan shows it.
struct SurfacePoint {
  Vec2 at;  ///< [m]
  Vec2
      normal;  ///< [1] unit vector across the surface, towards the sensor; (0, 0) where no neighbours show it.
};

/// Gives the points of a scan the normals of the surface through them and their neighbours, which lie within `reach` [m] and are at most 15
/// places away. A point whose neighbours lie on no line gets none.
/// @param points  of one scan, in the order of its beams.  @param sensor  where it was taken from; the same frame.
[[nodiscard]] std::vector<SurfacePoint> surface_of(std::span<const Vec2> points, Vec2 sensor,
                                                   double reach = 0.3);

/// Takes one point of those that lie within `apart` [m] of each other, and then at most `most`.
/// @param points  of one scan, in the order of its beams.
/// @thread  pure function; any thread.
[[nodiscard]] std::vector<SurfacePoint> thinned(std::span<const SurfacePoint> points, double apart,
                                                std::size_t most);

/// Surface points of many scans, of which the nearest to a place is found fast.
///
/// Thread contract: as for a container.
class SurfaceMap {
 public:
  /// Adds a scan.
  /// @param X_MR  the pose of the scan's frame in that of the map.
  void add(std::span<const SurfacePoint> scan, const Pose2& X_MR);

  /// Returns the nearest point within `reach` [m], at most kReach, or null.
  /// @pre  prepare() was called after the last add().
  [[nodiscard]] const SurfacePoint* nearest(Vec2 place, double reach) const;
  /// Sorts what was added.
  void prepare();

  [[nodiscard]] std::span<const SurfacePoint> points() const { return points_; }
  static constexpr double kReach = 0.5;  ///< [m]

 private:
  // Returns the points in a part of a row of cells, of which the lattice holds all.
  [[nodiscard]] std::span<const SurfacePoint> in_row(int row, int first, int last) const;

  std::vector<SurfacePoint> points_;
  Lattice lattice_{{}, kReach / 5.0, 0, 0};
  std::vector<std::uint32_t> begin_;  // of each cell's points
};

}  // namespace orca::nav
