// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/navigation/path.hpp"
#include "orca/navigation/pure_pursuit.hpp"
#include "orca/navigation/retreat.hpp"

namespace orca::nav {

/// A way to get on where nothing leads on.
enum class Recovery : std::uint8_t {
  back_off,  ///< Backwards along the way that the robot has come, see Retreat; each time farther.
  clear,  ///< Stands for a moment, and doubts what it knows: what a scan looks through is free, also where no echo says so.
  look_around,  ///< Turns on the spot, as its corners find room, and doubts meanwhile.
  wait          ///< Stands for 4 s: what is in the way may go.
};

/// The names of all, in the order of the enumeration.
inline constexpr std::array<std::string_view, 4> kRecoveryNames{"back_off", "clear", "look_around", "wait"};

[[nodiscard]] constexpr std::string_view name_of(Recovery recovery) {
  return kRecoveryNames[static_cast<std::size_t>(recovery)];
}

/// Returns whether a robot doubts meanwhile what it has seen.
[[nodiscard]] constexpr bool doubts(std::optional<Recovery> recovery) {
  return recovery == Recovery::clear || recovery == Recovery::look_around;
}

/// Returns the recovery of that name; nothing if there is none.
[[nodiscard]] constexpr std::optional<Recovery> recovery_of(std::string_view name) {
  for (std::size_t i = 0; i < kRecoveryNames.size(); ++i)
    if (kRecoveryNames[i] == name) return static_cast<Recovery>(i);
  return std::nullopt;
}

/// Recoveries in the order in which they are tried; after the last one the first again.
using RecoveryOrder = std::vector<Recovery>;

/// The order of the planners. A robot that has backed off sees more; to resolve a doubt takes a moment only.
inline const RecoveryOrder kUsualRecoveries{Recovery::back_off, Recovery::clear, Recovery::look_around,
                                            Recovery::back_off, Recovery::wait};

/// The state of the robot at one instant.
struct Moment {
  TimePoint now;
  Pose2 pose;    ///< in the frame of the map.
  Twist2 twist;  ///< in the robot's frame.
};

/// The part of a planner that drives: it follows a path among the obstacles near the robot, and recovers where nothing leads on.
///
/// Recovery: after `patience` without a motion that is free, after 3 s without any, and after 8 s near one place - 3 s if no way leads
/// to the goal - it does the next of its recoveries.
///
/// Thread contract: one thread at a time.
class PathDriver {
 public:
  explicit PathDriver(const Footprint& footprint, RecoveryOrder order = kUsualRecoveries)
      : footprint_(footprint), retreat_(footprint), order_(std::move(order)) {}

  /// Sets which recoveries it tries, in turn; none: it stands where nothing leads on.
  void set_recoveries(RecoveryOrder order) { order_ = std::move(order); }

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
  /// The manner in which a path is followed.
  struct Manner {
    double last_speed = 0.0;  ///< [m/s] at the end of the path.
    double patience = 1.0;    ///< [s] without a free motion after which a recovery begins.
    bool leads_there = true;  ///< Whether the path ends at the goal.
  };
  /// Follows a path from its place on it.
  /// @pre  the path is not empty.
  [[nodiscard]] Steer follow_path(const Path& path, const Moment& moment, const Pursuit& pursuit,
                                  const Manner& manner);
  /// Stops all that it does.
  void reset();

  /// The points of obstacles near the robot, map frame.
  [[nodiscard]] std::vector<Vec2>& points() { return points_; }
  /// Returns the place of the robot on the path [m].
  [[nodiscard]] double along() const { return along_; }
  [[nodiscard]] bool is_blocked() const { return blocked_since_.has_value(); }
  [[nodiscard]] bool recovers() const { return recovers_since_.has_value(); }
  /// Returns the recovery that goes on; nothing: none does, or none has done anything yet.
  [[nodiscard]] std::optional<Recovery> recovery() const {
    return recovers() && acts_ ? std::optional(recovery_) : std::nullopt;
  }
  /// Returns how often it has recovered since the last reset().
  [[nodiscard]] int recoveries() const { return recoveries_; }
  /// Returns how far the robot can drive straight on [m], at most 1.5 m.
  [[nodiscard]] double room_ahead(const Pose2& pose, double margin) const;

  /// Names what it knows, so that another one can go on from there.
  [[nodiscard]] auto state() {
    return std::tie(points_, along_, turning_, blocked_since_, recovers_since_, recovery_, acts_, turned_,
                    faced_, stood_at_, moved_at_, left_, left_at_, recoveries_, retreats_, retreat_);
  }

 private:
  [[nodiscard]] Scene scene(const Moment& moment, const Pursuit& pursuit) const;
  void watch(const Steer& steer, const Moment& moment, const Manner& manner, double speed);
  void note_motion(const Moment& moment);
  void begin_recovery(const Moment& moment);
  [[nodiscard]] std::optional<Steer> go_on(const Moment& moment, const Pursuit& pursuit,
                                           const Retreat::Seen& seen);
  [[nodiscard]] std::optional<Steer> look_around(const Moment& moment, const Pursuit& pursuit);

  Footprint footprint_;
  Retreat retreat_;
  RecoveryOrder order_;
  std::vector<Vec2> points_;
  double along_ = 0.0;
  bool turning_ = false;  // on the spot
  std::optional<TimePoint> blocked_since_;
  std::optional<TimePoint> recovers_since_;
  Recovery recovery_ = Recovery::back_off;  // the last one
  bool acts_ = false;                       // it has done something
  double turned_ = 0.0;                     // [rad] while looking around
  double faced_ = 0.0;                      // [rad] yaw of its last lap
  Pose2 stood_at_;                          // where it last made way
  TimePoint moved_at_{};                    // when
  Vec2 left_;                               // a place that it has not left since
  TimePoint left_at_{};                     // then
  int recoveries_ = 0;
  int retreats_ = 0;  // of these
};

}  // namespace orca::nav
