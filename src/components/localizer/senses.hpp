// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/objects/waiting_scans.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/navigation/beams.hpp"
#include "orca/navigation/map_localizer.hpp"
#include "orca/navigation/pose_history.hpp"

namespace orca::localizer {

/// A scan whose time has come, and when it was taken.
struct TakenScan {
  nav::RobotScan scan;
  TimePoint stamp;
  Pose2 X_OR;
};

/// The scans of any number of lasers, each of which waits until odometry has come that is newer than its last beam.
///
/// Thread contract: one strand.
class Scans {
 public:
  /// @param laser  "component.port" of its server.
  void add(const std::string& laser, ScanPtr scan);
  void clear();
  /// Returns the next scan of which it is known where it was taken, in the robot's frame at its first beam. The newest of a laser's
  /// waiting scans counts, older ones are dropped.
  /// @param range [m]  beyond which echoes do not count.
  [[nodiscard]] std::optional<TakenScan> take(const nav::PoseHistory& odometry, double range);

 private:
  struct Laser {
    std::string path;
    WaitingScans waiting;
  };
  std::vector<Laser> lasers_;
  std::vector<nav::Beam> beams_;
};

/// The echoes of any number of sonar rings since they were taken last.
///
/// Thread contract: one strand.
class Echoes {
 public:
  /// Adds what a round says that is new: a sonar whose stamp has not changed has not fired again.
  /// @param ring  "component.port" of its server.
  void add(const std::string& ring, const idl::SonarRangeReadings& round, const nav::PoseHistory& odometry);
  void clear() { fired_.clear(); }
  /// Returns them as seen from where the robot is now, and forgets them.
  [[nodiscard]] std::vector<nav::SonarEcho> take(const Pose2& X_OR);
  [[nodiscard]] bool empty() const { return fired_.empty(); }

 private:
  struct Ring {
    std::string path;
    std::vector<TimePoint> stamps;
  };
  struct Fired {
    Pose2 X_OS;
    nav::SonarEcho echo;
  };
  std::vector<Ring> rings_;
  std::vector<Fired> fired_;
};

/// All that a robot senses, and where odometry had it then.
///
/// Thread contract: one strand.
class Senses {
 public:
  void move(TimePoint stamp, const Pose2& X_OR) { odometry_.add(stamp, X_OR); }
  void add_scan(const std::string& laser, ScanPtr scan) { scans_.add(laser, std::move(scan)); }
  void add_round(const std::string& ring, const idl::SonarRangeReadings& round) {
    echoes_.add(ring, round, odometry_);
  }
  void clear() {
    odometry_.clear();
    scans_.clear();
    echoes_.clear();
  }
  /// As Scans::take().
  [[nodiscard]] std::optional<TakenScan> take_scan(double range) { return scans_.take(odometry_, range); }
  [[nodiscard]] bool has_echoes() const { return !echoes_.empty(); }
  /// As Echoes::take().
  [[nodiscard]] std::vector<nav::SonarEcho> take_echoes(const Pose2& X_OR) { return echoes_.take(X_OR); }

 private:
  nav::PoseHistory odometry_;
  Scans scans_;
  Echoes echoes_;
};

}  // namespace orca::localizer
