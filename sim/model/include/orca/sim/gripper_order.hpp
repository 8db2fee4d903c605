// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::sim {

/// What the paddles of a gripper are told: `stay` leaves them to their former order, `halt` stops them where they are.
enum class Paddles { stay, open, close, halt };

/// What the lift of a gripper is told; `stay` and `halt` as above.
enum class Lift { stay, up, down, halt };

/// A command to a gripper. A plain value.
struct GripperOrder {
  Paddles paddles = Paddles::stay;
  Lift lift = Lift::stay;
};

}  // namespace orca::sim
