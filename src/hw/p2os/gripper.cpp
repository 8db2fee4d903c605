// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/gripper.hpp"

#include "orca/hw/p2os/command.hpp"

namespace orca::hw::p2os {

Packet encode_gripper(GripperAction action) { return encode(Command::gripper, static_cast<int>(action)); }

// A paddle with contact pulls its input down.
GripperState gripper_of(const PortState& ports) {
  const auto state = [&](unsigned bit) { return ((ports.gripper >> bit) & 1U) != 0; };
  const auto input = [&](unsigned bit) { return ((ports.digital_in >> bit) & 1U) != 0; };
  return {.open = state(0),
          .closed = state(1),
          .paddles_move = state(2),
          .up = state(4),
          .down = state(5),
          .lift_moves = state(6),
          .inner_beam = input(3),
          .outer_beam = input(2),
          .left_contact = !input(4),
          .right_contact = !input(5)};
}

}  // namespace orca::hw::p2os
