// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/distance_transform.hpp"
#include "orca/navigation/footprint.hpp"
#include "orca/navigation/lattice.hpp"
#include "orca/navigation/occupancy_map.hpp"
#include "orca/navigation/reeds_shepp.hpp"

namespace orca::nav {

/// The occupied cells of a map, each as a whole square, against which the exact outline of a robot is tried at any pose. Where the next occupied
/// cell is farther than the outline's outer circle nothing is computed. Elsewhere the outline is cut into the rows of the lattice, and
/// the occupied cells of each part are counted by two look-ups.
///
/// Thread contract: as for a container.
class OutlineGrid {
 public:
  /// Takes over what is occupied.
  /// @param margin [m]  around the outline.
  void look_at(const OccupancyMap& map, const Footprint& footprint, double margin);

  /// Returns how many occupied cells the outline and its margin touch. All that is outside of the lattice is free.
  [[nodiscard]] int touched(const Pose2& pose) const;

  /// Follows a way as far as it may be driven: where the outline touches something at the start it may leave, but never touch more.
  /// @param step [m]  at which the outline is tried, besides at the end of each piece.
  /// @return whether it may be driven to its end.
  [[nodiscard]] bool may_drive(Pose2 pose, std::span<const WayPiece> way, double step) const;

  [[nodiscard]] const Lattice& lattice() const { return lattice_; }

 private:
  // The part of the x axis that the outline covers in a row.
  struct Stretch {
    double low, high;
  };
  [[nodiscard]] Stretch stretch(std::span<const Vec2, 4> corners, double low, double high) const;
  [[nodiscard]] Stretch stretch_of_circle(Vec2 middle, double low, double high) const;
  [[nodiscard]] int occupied_in(int row, const Stretch& stretch) const;
  [[nodiscard]] int touched_by_circle(Vec2 middle) const;

  Lattice lattice_;
  double cells_per_metre_ = 1.0;
  Footprint footprint_;  // with the margin
  DistanceTransform transform_;
  std::vector<std::uint8_t> obstacles_;
  std::vector<std::uint8_t> near_;    // of each cell: whether the outline may touch something from there
  std::vector<std::int32_t> so_far_;  // occupied cells in the row before each column, and in all of it
};

}  // namespace orca::nav
