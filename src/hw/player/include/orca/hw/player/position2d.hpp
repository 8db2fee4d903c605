// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

#include "orca/hw/player/message.hpp"
#include "orca/hw/player/payload.hpp"

/// Messages of the interface position2d.
namespace orca::hw::player {

/// Position2dState.
inline constexpr MessageId kPosition2dState{Interface::position2d, MessageType::data, 1};
/// VelocityCommand. Many drivers have no time limit: send a zero velocity before silence.
inline constexpr MessageId kPosition2dVelocity{Interface::position2d, MessageType::command, 1};
/// Empty; answered by Geometry.
inline constexpr MessageId kPosition2dAskGeometry{Interface::position2d, MessageType::request, 1};
/// Switch; the answer is empty.
inline constexpr MessageId kPosition2dMotorPower{Interface::position2d, MessageType::request, 2};
/// A mode of the driver; the answer is empty.
inline constexpr MessageId kPosition2dVelocityMode{Interface::position2d, MessageType::request, 3};
/// Planar: the pose that the odometry shall report; the answer is empty.
inline constexpr MessageId kPosition2dSetOdometry{Interface::position2d, MessageType::request, 5};
/// Empty, as is the answer.
inline constexpr MessageId kPosition2dResetOdometry{Interface::position2d, MessageType::request, 6};

/// Where a robot is by its odometry, and how it moves.
struct Position2dState {
  static constexpr std::string_view kName = "position2d STATE";
  Planar pose{};
  Planar velocity{};  ///< In the robot frame.
  bool stall = false;
  friend bool operator==(const Position2dState&, const Position2dState&) = default;
};

struct VelocityCommand {
  static constexpr std::string_view kName = "position2d VEL";
  Planar velocity{};  ///< In the robot frame.
  bool motors_on = true;
  friend bool operator==(const VelocityCommand&, const VelocityCommand&) = default;
};

}  // namespace orca::hw::player
