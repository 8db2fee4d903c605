// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "crossing.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::gate {

/// A firing of a sonar. A plain value.
struct Firing {
  std::size_t sonar = 0;  ///< Its number in the ring.
  double time = 0.0;      ///< [s]
  double range = 0.0;     ///< [m]; at or above `farthest` nothing was heard.
  double farthest = 0.0;  ///< [m]
  Pose2 X_OS{};           ///< The sonar's, in the frame of the odometry.
};

/// The people who come from where no laser looks: a sonar hears something nearer each time than the robot's own motion explains.
///
/// An echo counts if no laser has shown what is there; one that does not is where somebody may begin to walk. It comes nearer if it is heard nearer than the echo before would be heard now, at the
/// pace of somebody who walks, kTimes in a row.
///
/// Thread contract: as for a container.
class Flanks {
 public:
  static constexpr double kRange = 2.5;    ///< [m] in which echoes count.
  static constexpr double kSlowest = 0.3;  ///< [m/s]
  static constexpr double kFastest = 2.5;  ///< [m/s] Something that comes faster is another thing.
  static constexpr int kTimes = 2;
  static constexpr double kFresh = 0.7;  ///< [s] An echo says nothing about later.

  /// Takes a firing.
  /// @param explained  whether a laser has shown something where the echo is, or looks there.
  void hear(const std::string& ring, const Firing& firing, bool explained);
  /// Forgets all.
  void clear() { sonars_.clear(); }
  /// Returns those who come, in the frame of the robot.
  [[nodiscard]] std::vector<Passer> comers(double now, const Pose2& X_OR) const;

 private:
  struct Sonar {
    std::string ring;
    std::size_t number = 0;
    Vec2 place;         // [m] of the last echo, in the frame of the odometry
    double heard = -1;  // [s] when; negative: nothing that counts
    int nearer = 0;     // times in a row
    Vec2 velocity;      // [m/s] that brings it nearer
  };
  Sonar& sonar(const std::string& ring, std::size_t number);

  std::vector<Sonar> sonars_;
};

}  // namespace orca::gate
