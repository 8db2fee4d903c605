// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

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
  /// Takes over a map, or a tile of the one that is there: it has the same name and resolution and lies within it.
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

 private:
  bool take_tile(const idl::OccupancyGrid& grid);

  std::string name_;
  double yaw_ = 0.0;
  nav::FloorGrid grid_;
  bool changed_ = false;
};

}  // namespace orca::planning
