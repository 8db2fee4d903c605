// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// A place where something touches or nearly touches a robot.
struct Touch {
  Vec2 point;             // Place in the base frame.
  double distance = 0.0;  // [m] Distance between the two; negative if they overlap.
};

// A bumper in segments. A reading reports each segment that was pressed at any time since the reading before,
// so that no touch shorter than the period is lost.
class BumperModel {
 public:
  BumperModel(BumperRing ring, TimePoint start);

  // Presses and releases the segments for one tick.
  // @param touches  all touches of the robot at `now`, the end of the tick.
  // @param X_RB     pose of the body in the robot's frame.
  void run(std::span<const Touch> touches, TimePoint now, const Pose2& X_RB);

  // Returns the reading that became due in the last run(), if one did.
  [[nodiscard]] const std::optional<BumperReading>& completed() const { return completed_; }

 private:
  [[nodiscard]] bool reaches(std::size_t segment, const Touch& touch) const;

  BumperRing ring_;
  TimePoint due_;
  std::vector<bool> pressed_;  // Segments that are pressed now.
  std::vector<bool> felt_;     // Segments that were pressed since the last reading.
  std::optional<BumperReading> completed_;
};

}  // namespace orca::sim::detail
