// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orca/hw/p2os/packet.hpp"
#include "orca/hw/p2os/sip.hpp"

namespace orca::hw::p2os {

/// What the gripper of a Pioneer 2 can be told: the argument of Command::gripper. Paddles and lift go on until they are at their
/// ends, or meet something, or are told to stop.
/// @source  gripper commands of the vendor, as the public drivers Player (p2os) and ARIA (ArGripper) name them.
enum class GripperAction : std::uint8_t {
  open = 1,        ///< Opens the paddles.
  close = 2,       ///< Closes the paddles.
  stop = 3,        ///< Stops the paddles.
  lift_up = 4,     ///< Lifts.
  lift_down = 5,   ///< Lowers.
  lift_stop = 6,   ///< Stops the lift.
  store = 7,       ///< Closes the paddles and lifts.
  deploy = 8,      ///< Opens the paddles and lowers.
  halt = 15,       ///< Stops paddles and lift.
  press = 16,      ///< Sets how hard the paddles press, to the value of Command::gripperval.
  lift_carry = 17  ///< Moves the lift for the time of Command::gripperval.
};

/// Returns Command::gripper.
[[nodiscard]] Packet encode_gripper(GripperAction action);

/// What a gripper tells of itself.
///
/// A plain value.
/// @source  the bits of the state byte by Player's p2os driver; those of the digital inputs by ARIA's ArGripper, with which Player's
/// clients agree on the beams.
struct GripperState {
  bool open = false;           ///< The paddles are as far apart as they can be.
  bool closed = false;         ///< The paddles are together.
  bool paddles_move = false;   ///< They are on their way.
  bool up = false;             ///< The lift is at its upper end.
  bool down = false;           ///< The lift is at its lower end.
  bool lift_moves = false;     ///< It is on its way.
  bool inner_beam = false;     ///< Something is in the beam near the robot.
  bool outer_beam = false;     ///< Something is in the beam near the tips.
  bool left_contact = false;   ///< Something presses on the left paddle.
  bool right_contact = false;  ///< Something presses on the right paddle.
  friend bool operator==(const GripperState&, const GripperState&) = default;
};

/// Returns the state of the gripper that is connected to these ports. @pre  one is; without one the bits mean nothing.
[[nodiscard]] GripperState gripper_of(const PortState& ports);

}  // namespace orca::hw::p2os
