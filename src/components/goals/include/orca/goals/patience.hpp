// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <tuple>

#include "orca/base/time.hpp"

namespace orca::go {

/// The watch over the progress towards one point. Progress is to come nearer than ever before, by 0.1 m at
/// least: on the planned way for a robot that plans, otherwise through the air.
class Patience {
 public:
  Patience() = default;
  /// Starts again: the point is another one.
  void begin() { *this = Patience(plans_); }

  /// Takes note of what is left of the planned way to the point [m]; nothing while there is none.
  void note_plan(std::optional<double> left) {
    plans_ = true;
    left_ = left;
  }
  /// Takes note of the present distance to the point [m].
  /// @return for how long there has been no progress [s].
  double note(double distance, TimePoint now) {
    if (plans_ && left_) note_other_way(*left_);
    const double left = plans_ ? left_.value_or(nearest_) : distance;
    if (left < nearest_ - kProgress || since_ == TimePoint{}) {
      nearest_ = left;
      since_ = now;
    }
    return to_seconds(now - since_);
  }

  /// Returns what is left of the planned way to the point [m], if there is a plan.
  [[nodiscard]] std::optional<double> plan_left() const { return left_; }
  /// Returns the smallest distance so far [m], to within 0.1 m; infinite if there is none.
  [[nodiscard]] double nearest() const { return nearest_; }

  /// Returns what is passed on to another version of Goto: how near the robot has come, and when.
  auto state() { return std::tie(nearest_, since_); }

 private:
  static constexpr double kProgress = 0.1;  // [m]
  static constexpr double kAnother = 1.0;   // [m]
  static constexpr int kMostWays = 3;

  explicit Patience(bool plans) : plans_(plans) {}

  // A way that is longer by a metre than what was left is another one: it leads around what is in the way of the first. To have
  // found it is no progress yet. Only a few count: where no way leads to the point, a planner finds ever other ones through what it
  // has not seen.
  void note_other_way(double left) {
    if (left < nearest_ + kAnother || ways_ == kMostWays) return;
    nearest_ = left;
    ++ways_;
  }

  double nearest_ = std::numeric_limits<double>::infinity();
  TimePoint since_{};
  bool plans_ = false;
  std::optional<double> left_;  // [m] of the planned way
  int ways_ = 0;                // other ones
};

}  // namespace orca::go
