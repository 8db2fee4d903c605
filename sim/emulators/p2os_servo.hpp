// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::emulators {

/// What a Pioneer's controller does by itself: it drives a way, or turns to a heading, and then stands.
///
/// Thread contract: not synchronised.
class P2osServo {
 public:
  /// Sets the speed [m/s] and the turn rate [rad/s] of such motions.
  void set_speed(double speed) { speed_ = speed; }
  void set_turn_rate(double turn_rate) { turn_rate_ = turn_rate; }

  /// Begins to drive so far [m], backward if it is negative.
  void move(double way, const Pose2& from);
  /// Begins to turn to a heading [rad].
  void turn_to(double heading) { heading_ = heading; }
  /// Ends both.
  void cease();
  [[nodiscard]] bool works() const { return goal_ || heading_; }

  /// Returns the velocity at this pose. When it has got there, it stands, and works no more.
  [[nodiscard]] Twist2 velocity(const Pose2& pose);

 private:
  struct Goal {
    Pose2 from;
    double way;
  };

  double speed_ = 0.4;
  double turn_rate_ = 1.0;
  std::optional<Goal> goal_;
  std::optional<double> heading_;
};

}  // namespace orca::emulators
