// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/gripper.hpp"

#include "orca/hw/p2os/command.hpp"

namespace orca::hw::p2os {
namespace {

bool is_set(unsigned bits, unsigned number) { return ((bits >> number) & 1U) != 0; }

}  // namespace

Packet encode_gripper(GripperAction action) { return encode(Command::gripper, static_cast<int>(action)); }

GripperState gripper_of(const PortState& ports) {
  return {.open = is_set(ports.gripper, 0),
          .closed = is_set(ports.gripper, 1),
          .paddles_move = is_set(ports.gripper, 2),
          .up = is_set(ports.gripper, 4),
          .down = is_set(ports.gripper, 5),
          .lift_moves = is_set(ports.gripper, 6),
          .inner_beam = is_set(ports.digital_in, 3),
          .outer_beam = is_set(ports.digital_in, 2),
          .left_contact =
              !is_set(ports.digital_in, 4),  // the switches of the paddles are 0 when they are pressed
          .right_contact = !is_set(ports.digital_in, 5)};
}

}  // namespace orca::hw::p2os
