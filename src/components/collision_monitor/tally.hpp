// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "orca/base/time.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::gate {

/// The account of what the gate did while somebody wanted to drive.
///
/// Thread contract: as for a container.
class Tally {
 public:
  /// Notes a motion of the robot. @param now  when it is reported; times only grow.
  void add(TimePoint now, const Twist2& twist) {
    if (moved_at_) way_ += speed_of(twist) * to_seconds(now - *moved_at_);
    moved_at_ = now;
  }
  /// Notes what was left of a command. Commands with more than kGap in between do not belong together.
  /// @return whether a stop begins: the robot was free, or driving slowly, for at least kGap.
  bool note(TimePoint now, double share) {
    const double time = noted_at_ ? std::fmin(to_seconds(now - *noted_at_), kGap) : 0.0;
    noted_at_ = now;
    wanted_ += time;
    if (share < 1.0) (share > 0.0 ? slowed_ : stood_) += time;
    if (share > 0.0) {
      stands_since_.reset();
      return false;
    }
    if (!stands_since_) stands_since_ = now;
    const bool begins = !stood_at_ || to_seconds(now - *stood_at_) > kGap;
    stood_at_ = now;
    stops_ += begins ? 1 : 0;
    return begins;
  }
  /// Returns for how long [s] no command has passed.
  [[nodiscard]] double stands_for(TimePoint now) const {
    return stands_since_ ? to_seconds(now - *stands_since_) : 0.0;
  }
  /// Returns whether it has changed any command.
  [[nodiscard]] bool has_acted() const { return stood_ > 0.0 || slowed_ > 0.0; }
  /// Reports all of it in a line for people.
  [[nodiscard]] std::string text() const {
    char line[160];
    std::snprintf(line, sizeof line,
                  "in %.1f m and %.1f s of commands: %d stops, %.1f s stopped, %.1f s slowed", way_, wanted_,
                  stops_, stood_, slowed_);
    return line;
  }

 private:
  static constexpr double kGap = 1.0;  // [s]
  std::optional<TimePoint> moved_at_;
  std::optional<TimePoint> noted_at_;
  std::optional<TimePoint> stood_at_;      // The last command that did not pass.
  std::optional<TimePoint> stands_since_;  // The first of those since one that did.
  double way_ = 0.0;                       // [m]
  double wanted_ = 0.0;                    // [s]
  double slowed_ = 0.0;                    // [s]
  double stood_ = 0.0;                     // [s]
  int stops_ = 0;
};

}  // namespace orca::gate
