// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orca/emulators/body.hpp"

namespace orca::emulators {

// Carries out the argument of a gripper command; one that is not known moves nothing.
void move_gripper(Body& body, int action);
// Stops paddles and lift where they are.
void halt_gripper(Body& body);

// The state of the gripper in an information packet. Without a gripper both are 0.
struct GripperBytes {
  std::uint8_t state = 0;
  std::uint8_t inputs = 0;  // Digital ones.
};
[[nodiscard]] GripperBytes gripper_bytes(const Body& body);

}  // namespace orca::emulators
