// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/robot_model.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim {

/// How much of a robot counts.
enum class Extent {
  solid,        ///< Its parts, which is all that touches anything in a running world.
  with_paddles  ///< Its parts, and the paddles of its gripper, open and down as they are at first.
};

/// Something in which a robot would stand.
struct StandsIn {
  std::string name;  ///< Of the obstacle, item, leaf or robot. Obstacles of one name count as one.
  /// Where the robot would be clear of it, seldom more than 2 cm farther away than necessary; nothing within 5 m.
  std::optional<Pose2> clear{};
  double way = 0.0;  ///< [m] How far that is from where the robot would stand.
};

/// Returns everything of a world in which a robot would stand at its beginning: obstacles, leaves of doors as they are at first and
/// items. The robot counts with its paddles. Nothing for one that is fixed, which may be screwed to a wall.
///
/// Where people are at first is drawn, so they are left out.
/// @thread  pure function; any thread.
/// @source  FCL finds what meets: Pan, Chitta, Manocha, "FCL: A General Purpose Library for Collision and Proximity Queries", 2012.
[[nodiscard]] std::vector<StandsIn> what_holds(const RobotModel& robot, const Pose2& X_WB,
                                               const WorldModel& world);

/// Returns everything in which an item stands at first: obstacles, leaves of doors, and items that come before it in the world.
/// @thread  pure function; any thread.
[[nodiscard]] std::vector<StandsIn> what_holds(const Item& item, const WorldModel& world);

/// Says how something would be clear of what it stands in: "0.12 m from being clear of it at x 1 m, y 2.5 m".
[[nodiscard]] std::string how_to_clear(const StandsIn& there);

/// Returns the name of the first obstacle in which the parts of a robot would stand; nothing if it is free.
/// @thread  pure function; any thread.
[[nodiscard]] std::optional<std::string> obstacle_in(const RobotModel& robot, const Pose2& X_WB,
                                                     const WorldModel& world);

/// Returns whether two robots would stand in each other.
/// @thread  pure function; any thread.
[[nodiscard]] bool stand_in_each_other(const RobotModel& robot, const Pose2& X_WB, const RobotModel& other,
                                       const Pose2& X_WO, Extent extent);

/// Returns how a robot would be clear of another one in which it stands, both with their paddles; `name` is empty.
/// @thread  pure function; any thread.
[[nodiscard]] StandsIn way_out_of(const RobotModel& other, const Pose2& X_WO, const RobotModel& robot,
                                  const Pose2& X_WB);

}  // namespace orca::sim
