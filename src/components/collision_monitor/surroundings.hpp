// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flanks.hpp"
#include "orca/base/time.hpp"
#include "orca/collision/swept_body.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::gate {

/// A level scan, where it was taken.
struct Sweep {
  std::vector<double> ranges;    ///< [m]; at or above max_range nothing was seen, NaN: not read.
  double max_range = 0.0;        ///< [m]
  double angle_start = 0.0;      ///< [rad] of the first beam, in the frame of the sensor.
  double angle_increment = 0.0;  ///< [rad]
  Pose2 X_OS{};                  ///< The sensor's, in the frame of the odometry.
  double height = 0.0;           ///< [m] above the floor.
};

/// A reading of a sonar, where it fired.
struct Cone {
  std::size_t sonar = 0;    ///< Its number in the ring.
  double range = 0.0;       ///< [m] 0: something is at the sonar, and nobody knows how near.
  double farthest = 0.0;    ///< [m] A range at or above it is no echo.
  double half_angle = 0.0;  ///< [rad] of the part of the cone that counts.
  Pose2 X_OS{};             ///< The sonar's, in the frame of the odometry; x is the axis of the cone.
  Vec2 place{};             ///< [m] of the sonar, in the frame of the robot.
};

/// A part of the floor, in the frame of the robot.
struct Disc {
  Vec2 middle{};        ///< [m]
  double radius = 0.0;  ///< [m]
};

/// The surroundings as all sensors of a robot have seen them lately: upright posts in the frame of the odometry.
///
/// An echo shows that something is at the height of its sensor. Nobody knows how far it reaches down and up, so it counts at all heights
/// but for those at which another laser sees past it, and beyond. A scan replaces what the same laser saw before where it looks now;
/// what lies beside its field of view or behind something else is kept for kKept.
///
/// A sonar that hears nothing says little: near the robot an echo is lost between two cones, or below the least range. So an echo that was heard
/// twice is kept for kHeard, whatever the sonar hears then; one that was heard once is replaced by the next reading.
///
/// Thread contract: as for a container.
class Surroundings {
 public:
  static constexpr double kKept = 4.0;   ///< [s] that the robot drives; what lasers saw.
  static constexpr double kHeard = 1.5;  ///< [s] The same for sonars, whether it drives or not.
  static constexpr double kRange = 2.5;  ///< [m] from the sensor; what is farther away does not count.

  /// Forgets all.
  void clear() {
    sources_.clear();
    flanks_.clear();
  }
  /// Lets what is out of sight grow older by a time [s]. @param drives  whether the robot did meanwhile.
  void age(double time, bool drives);
  /// Takes a scan. @param source  name of the laser.
  void see(const std::string& source, Sweep sweep);
  /// Takes a reading of a sonar.
  void hear(const std::string& source, const Cone& cone);

  /// Takes a firing of a sonar that hears who comes from where no laser looks.
  /// @param half_lobe [rad]  half the opening angle of its cone.
  void hear_flank(const std::string& ring, const Firing& firing, double half_lobe);
  /// Forgets what was seen and heard where people move in sight: they are nothing that stands there.
  void forget(std::span<const Passer> people, const Pose2& X_OR);
  /// Returns those who come from where no laser looks, in the frame of the robot.
  [[nodiscard]] std::vector<Passer> comers(double now, const Pose2& X_OR) const {
    return flanks_.comers(now, X_OR);
  }

  /// Returns what counts now, in the frame of a robot. Valid until the next call.
  /// @param spared  what does not count: it is to be touched.
  [[nodiscard]] std::span<const collision::Post> posts(const Pose2& X_OR,
                                                       const std::optional<Disc>& spared = std::nullopt);
  /// Returns whose echo made a post of the last posts().
  [[nodiscard]] const std::string& source_of(std::size_t post) const;

 private:
  struct Echo {
    Vec2 place;               // [m] in the frame of the odometry
    double age = 0.0;         // [s]
    std::size_t sonar = 0;    // that heard it
    bool is_sure = false;     // a sonar has heard it twice
    bool is_carried = false;  // it is at a sonar: its place is in the frame of the robot
  };
  struct Source {
    std::string name;
    bool is_laser;
    Sweep sweep;  // the last one of a laser
    std::vector<Echo> echoes;
  };
  Source& source(const std::string& name, bool is_laser);
  [[nodiscard]] collision::Post post_of(const Source& source, Vec2 place) const;

  [[nodiscard]] bool is_looked_at(Vec2 place) const;
  [[nodiscard]] bool is_seen(Vec2 place, double room) const;

  std::vector<Source> sources_;
  Flanks flanks_;
  std::vector<collision::Post> posts_;
  std::vector<std::size_t> owners_;  // of each post, an index of sources_
};

/// Says what is in the way, for people.
[[nodiscard]] std::string text_of(const collision::Post& post, const collision::SweptBody& body,
                                  const std::string& source);

}  // namespace orca::gate
