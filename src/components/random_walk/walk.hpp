// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/random.hpp"

namespace orca::walk {

struct Limits {
  double speed = 0.0;          ///< [m/s] straight on.
  double turn_rate = 0.0;      ///< [rad/s] of a turn on the spot, above 0.
  double least_turn = 0.0;     ///< [rad]
  double greatest_turn = 0.0;  ///< [rad] at least least_turn.
  double blocked_at = 0.0;     ///< [m] a free way this short is turned away from.
  double longest_way =
      0.0;  ///< [s] of driving straight on; a turn comes after a random part of it. 0: never.
};

struct Step {
  double turn_rate = 0.0;  ///< [rad/s] counter-clockwise positive.
  double speed = 0.0;      ///< [m/s]
};

/// A random walk: straight on until the way is blocked or a random time has passed, then a turn on the spot
/// by a random angle to a random side.
///
/// Thread contract: not synchronised. Its steps depend only on the times, the free ways and the stream.
class Walk {
 public:
  /// @param time      [s] now, never less than before.
  /// @param free_way  [m] straight ahead.
  Step step(double time, double free_way, const Limits& limits, RandomStream& random);

 private:
  void begin_turn(double time, const Limits& limits, RandomStream& random);

  double turn_until_ = 0.0;  // [s]
  double drive_until_ = 0.0;
  double side_ = 1.0;
  bool begun_ = false;
};

}  // namespace orca::walk
