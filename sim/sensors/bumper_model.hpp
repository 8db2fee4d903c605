// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/sensors.hpp"

namespace orca::sim::detail {

// Where something touches or nearly touches a robot.
struct Touch {
  Vec2 point;             // In the base frame.
  double distance = 0.0;  // [m] Between the two; negative: they overlap.
};

// A bumper in segments. A touch shorter than the period is not lost: a reading tells what was pressed at any
// time since the one before.
class BumperModel {
 public:
  BumperModel(BumperRing ring, TimePoint start);

  // @param touches  all of the robot's, at the end of the tick, which was `now`.
  // @param X_RB     of the body in the robot's frame.
  void run(std::span<const Touch> touches, TimePoint now, const Pose2& X_RB);

  // The reading that became due in the last run(), if one did.
  [[nodiscard]] const std::optional<BumperReading>& completed() const { return completed_; }

 private:
  [[nodiscard]] bool reaches(std::size_t segment, const Touch& touch) const;

  BumperRing ring_;
  TimePoint due_;
  std::vector<bool> pressed_;  // Now.
  std::vector<bool> felt_;     // Since the last reading.
  std::optional<BumperReading> completed_;
};

}  // namespace orca::sim::detail
