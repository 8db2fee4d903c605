// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <tuple>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/navigation/path.hpp"
#include "orca/navigation/pure_pursuit.hpp"
#include "orca/navigation/retreat.hpp"

namespace orca::nav {

/// The state of the robot at one instant.
struct Moment {
  TimePoint now;
  Pose2 pose;    ///< in the frame of the map.
  Twist2 twist;  ///< in the robot's frame.
};

/// The part of a planner that drives: it follows a path among the obstacles near the robot, and recovers where nothing leads on.
///
/// Recovery: after `patience` without any motion it retreats (see Retreat), the farther the more often in a row.
///
/// Thread contract: one thread at a time.
class PathDriver {
 public:
  explicit PathDriver(const Footprint& footprint) : footprint_(footprint), retreat_(footprint) {}

  /// Begins at a place, where it has not stood yet.
  void begin(const Moment& moment);
  /// Goes on with a recovery.
  /// @param seen  whether the sensors have seen that nothing is at a point.
  /// @return nothing if there is none, or no more.
  [[nodiscard]] std::optional<Steer> recover(const Moment& moment, const Pursuit& pursuit,
                                             const Retreat::Seen& seen);
  /// Notes that the robot is there, on its own way.
  void note(const Pose2& pose) { retreat_.note(pose); }
  /// Finds the robot's place on a path again.
  /// @pre  not empty.
  void find_place(const Path& path, Vec2 robot);
  /// Begins a path at its start.
  void begin_path() { along_ = 0.0; }
  /// Follows a path from its place on it. If that leads nowhere for `patience` [s], a recovery begins.
  /// @param last_speed [m/s]  at the end of the path.  @pre  the path is not empty.
  [[nodiscard]] Steer follow_path(const Path& path, const Moment& moment, const Pursuit& pursuit,
                                  double last_speed, double patience);
  /// Stops all that it does.
  void reset();

  /// The points of obstacles near the robot, map frame.
  [[nodiscard]] std::vector<Vec2>& points() { return points_; }
  /// Returns the place of the robot on the path [m].
  [[nodiscard]] double along() const { return along_; }
  [[nodiscard]] bool is_blocked() const { return blocked_since_.has_value(); }
  [[nodiscard]] bool recovers() const { return backs_off_since_.has_value(); }
  /// Returns how often it has recovered since the last reset().
  [[nodiscard]] int recoveries() const { return recoveries_; }
  /// Returns how far the robot can drive straight on [m], at most 1.5 m.
  [[nodiscard]] double room_ahead(const Pose2& pose, double margin) const;

  /// Names what it knows, so that another one can go on from there.
  [[nodiscard]] auto state() {
    return std::tie(points_, along_, turning_, blocked_since_, backs_off_since_, stood_at_, moved_at_,
                    recoveries_, retreat_);
  }

 private:
  [[nodiscard]] Scene scene(const Moment& moment, const Pursuit& pursuit) const;
  void watch(const Steer& steer, const Moment& moment, double patience);

  Footprint footprint_;
  Retreat retreat_;
  std::vector<Vec2> points_;
  double along_ = 0.0;
  bool turning_ = false;  // on the spot
  std::optional<TimePoint> blocked_since_;
  std::optional<TimePoint> backs_off_since_;
  Pose2 stood_at_;        // where it last made way
  TimePoint moved_at_{};  // when
  int recoveries_ = 0;
};

}  // namespace orca::nav
