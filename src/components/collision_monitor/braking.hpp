// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "orca/collision/swept_body.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::gate {

/// How a base comes to rest. A plain value.
struct Brakes {
  double deceleration = 0.5;       ///< [m/s2] > 0
  double turn_deceleration = 1.0;  ///< [rad/s2] > 0
};

/// Returns the time [s] in which a base that brakes goes as far as without brakes in half of it: its braking distance at full speed.
/// @thread  pure function, as all of this file; any thread.
[[nodiscard]] double braking_time(const Twist2& twist, const Brakes& brakes);

/// Returns by how much [1] a motion must be slower, on the same arc, for a base to come to rest before its end.
/// @param free      [s] at full speed, to the end of the arc.
/// @param reaction  [s] in which the base goes on before it brakes.
[[nodiscard]] double share_to_stop(const Twist2& twist, double free, double reaction, const Brakes& brakes);

/// Returns whether a robot moves so slowly that it may touch what it is to touch: at 0.06 m/s at most, its corners at 0.12 m/s.
/// @param reach  [m] of its body.
[[nodiscard]] bool creeps(const Twist2& twist, double reach);

/// The motion that a robot is to make, and the one that it makes.
struct Intent {
  Twist2 wanted;      ///< The command.
  Twist2 present;     ///< The motion now.
  bool held = false;  ///< Whether the last command was made a stop: it needs some room to begin again.
};

/// The rules of the gate. A plain value.
struct Rules {
  Brakes gentle;          ///< Those of the base on any command.
  Brakes hard;            ///< Those of its emergency stop.
  double reaction = 0.3;  ///< [s] from an echo until the base brakes.
  double margin =
      0.02;  ///< [m] to keep from what was seen, at 0.2 m/s and more; less in proportion, at least a third.
};

/// The decision about a command.
struct Verdict {
  double share = 1.0;                 ///< [1] of the command's speed that is left; 0: stop.
  bool at_once = false;               ///< Whether only an emergency stop helps.
  std::optional<std::size_t> post{};  ///< The thing in the way; nothing: the way is free.
  bool gives_way = false;             ///< Whether the command is slowed down because of people who move.
};

/// Decides how fast the body may obey a command: so that it can stop, as on any command, before the body comes nearer to a post than
/// the margin. Where nothing may pass otherwise, the slowest motion may whose own margin is free: 0.08 m/s. If on its present arc even an emergency stop would only just do, it asks for that.
[[nodiscard]] Verdict judge(const collision::SweptBody& body, std::span<const collision::Post> posts,
                            const Intent& intent, const Rules& rules);

}  // namespace orca::gate
