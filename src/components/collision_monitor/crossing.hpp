// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "braking.hpp"
#include "orca/collision/swept_body.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/idl/moving.hpp"

namespace orca::gate {

/// Somebody who moves, in the frame of the robot as it stands now. A plain value.
struct Passer {
  static constexpr double kStands = 0.25;  ///< [m/s] Who is slower stands, as long as he is in sight.
  Vec2 place;                              ///< [m]
  Vec2 velocity;                           ///< [m/s] over the floor
  double radius = 0.3;                     ///< [m]
  double place_error = 0.0;                ///< [m] standard deviation
  double velocity_error = 0.0;             ///< [m/s] the same
  double unseen = 0.0;                     ///< [s] since he was seen
};

/// Adds those who move, as they are now if they have gone on.
/// @param age [s]  of what is known of them.   @param X_OR  the robot's now, in the frame of the odometry.
void add_passers(const idl::MovingThings& moving, double age, const Pose2& X_OR, std::vector<Passer>& people);

/// Describes somebody, for people.
[[nodiscard]] std::string text_of(const Passer& passer);

/// The decision about a command among people who move. A plain value.
struct Crossing {
  double share = 1.0;                ///< [1] of the command's speed that is left; 0: stand.
  bool at_once = false;              ///< Whether only an emergency stop helps.
  std::optional<std::size_t> who{};  ///< Who is in the way; nothing: nobody is.
};

/// Decides how fast the body may obey a command among people who go on as they go: as fast as it touches nobody within kAhead, so that it
/// lets pass who crosses its way, and clears the way of others. Where it would be touched either way, it stands by then.
///
/// Somebody who is nearer than the margin already holds no motion that does not come nearer.
/// @source  Kant and Zucker, "Toward Efficient Trajectory Planning: The Path-Velocity Decomposition", IJRR 5(3), 1986, for speeds along a
///          given way; Bouraine, Fraichard and Salhi, "Provably Safe Navigation for Mobile Robots with Limited Field-of-Views in Dynamic
///          Environments", Autonomous Robots 32, 2012, for the least that can be kept: the robot stands when it is touched.
/// @thread  pure function; any thread.
[[nodiscard]] Crossing cross(const collision::SweptBody& body, std::span<const Passer> people,
                             const Intent& intent, const Rules& rules);

}  // namespace orca::gate
