// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <tuple>

#include "orca/base/result.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/navigation/known_map.hpp"

namespace orca::planning {

/// The map as it has come: a whole one, and tiles of it that have changed since.
///
/// Thread contract: one strand.
class Floor {
 public:
  static constexpr std::uint64_t kMostCells = 100'000'000;  ///< 10 cm of 1 km2
  static constexpr std::uint64_t kMostToPlan =
      (1U << 24U) - 1U;  ///< that GridSearch can search: 5 cm of 0.04 km2

  /// The fate of a map when something comes that lies beyond its edge.
  enum class Edge {
    fixed,  ///< It is another map, such as the window of a WorldModel that has moved on.
    grows   ///< The map grows: a SlamLocalizer makes it.
  };

  /// @param most_cells  that it takes, at most kMostCells.
  explicit Floor(std::uint64_t most_cells = kMostCells, Edge edge = Edge::fixed)
      : most_cells_(most_cells), edge_(edge) {}

  /// Takes over a map, or a tile of the one that is there: it has the same name and resolution, and cells in the same places.
  /// @errors  invalid_argument with what is wrong with it. Then all stays as it was.
  Status take(const idl::OccupancyGrid& grid);

  /// Sets the direction of the frame of a map that is still to come.
  void expect(double yaw) { yaw_ = yaw; }
  /// Returns whether something was taken since map() was called.
  [[nodiscard]] bool has_changed() const { return changed_; }
  /// Returns the map for looking in it; null: there is none.
  [[nodiscard]] std::shared_ptr<const nav::KnownMap> map();
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns its cells, in the frame of map(); none: there is no map.
  [[nodiscard]] const nav::FloorGrid& grid() const { return grid_; }
  /// Returns the pose in the world of the frame in which map() is: both have the same origin, but rows of cells lie along the frame's x axis.
  [[nodiscard]] Pose2 X_WM() const { return {0.0, 0.0, yaw_}; }
  /// Names what a successor of the component goes on with, if nobody sends the map again.
  [[nodiscard]] auto state() {
    nav::Lattice& lattice = grid_.lattice;
    return std::tie(name_, yaw_, lattice.corner, lattice.side, lattice.columns, lattice.rows, grid_.cells);
  }

 private:
  bool take_tile(const idl::OccupancyGrid& grid);
  bool grow_to(nav::Cell first, nav::Cell last);

  std::uint64_t most_cells_;
  Edge edge_;
  std::string name_;
  double yaw_ = 0.0;
  nav::FloorGrid grid_;
  bool changed_ = false;
};

}  // namespace orca::planning
