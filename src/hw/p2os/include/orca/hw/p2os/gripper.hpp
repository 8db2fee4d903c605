// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orca/hw/p2os/packet.hpp"
#include "orca/hw/p2os/sip.hpp"

namespace orca::hw::p2os {

/// What Command::gripper makes the gripper do: two paddles, on a lift. Both stop by themselves at their ends.
/// @source  Pioneer Gripper manual, "AROS Gripper client command set".
enum class GripperAction : std::uint8_t {
  open = 1,   ///< Opens the paddles.
  close = 2,  ///< Closes the paddles, on each other or on what is between them.
  up = 4,     ///< Raises the lift to its upper end.
  down = 5,   ///< Lowers the lift to its lower end.
  halt = 15,  ///< Stops paddles and lift where they are.
};

/// Returns Command::gripper.
[[nodiscard]] Packet encode_gripper(GripperAction action);

/// State of a gripper at the user ports, as Pioneers have it. That of a PeopleBot is at other ports.
///
/// A plain value.
struct GripperState {
  bool open = false;    ///< The paddles are open. If it equals `closed`, it is not known where they are.
  bool closed = false;  ///< The paddles are closed.
  bool paddles_move = false;  ///< The paddles open or close.
  bool up = false;  ///< The lift is at its upper end. If it equals `down`, it is not known where the lift is.
  bool down = false;           ///< The lift is at its lower end.
  bool lift_moves = false;     ///< The lift goes up or down.
  bool inner_beam = false;     ///< Something interrupts the beam near the robot.
  bool outer_beam = false;     ///< Something interrupts the beam near the tips of the paddles.
  bool left_contact = false;   ///< Something presses on the left paddle.
  bool right_contact = false;  ///< Something presses on the right paddle.
  friend bool operator==(const GripperState&, const GripperState&) = default;
};

/// Returns the state of the gripper.
/// @pre  The robot has a gripper. Without one the inputs mean something else: where all are 0, both paddles seem to be pressed.
/// @source  Pioneer Gripper manual, "Gripper state byte" and "User I/O DIGIN bits".
[[nodiscard]] GripperState gripper_of(const PortState& ports);

}  // namespace orca::hw::p2os
