// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <vector>

#include "orca/avoidance/scan.hpp"

namespace orca::avoid {

/// The floor that lasers have seen to be free on the robot's last metres. A low thing that they look over may stand there.
///
/// Thread contract: one thread at a time.
class SeenFloor {
 public:
  /// Notes a scan, unless the last one that was kept was taken from nearly the same place.
  /// @param scan  only its beams count, not its X_RS.
  /// @param X_OS  the sensor's pose in a frame that does not move, as that of the odometry.
  void note(const Scan& scan, const Pose2& X_OS);
  /// Returns whether a point of that frame lies before what a kept scan has seen.
  [[nodiscard]] bool has(Vec2 point) const;
  void clear() { views_.clear(); }
  [[nodiscard]] bool empty() const { return views_.empty(); }

 private:
  struct View {
    Pose2 X_OS;
    double start = 0.0;          // [rad] of the first sector, sensor frame
    std::vector<double> free{};  // [m] by sector
  };
  [[nodiscard]] static bool shows(const View& view, Vec2 point);

  std::deque<View> views_;  // oldest first
};

}  // namespace orca::avoid
