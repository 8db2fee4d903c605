// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"

namespace orca::follow {

/// Somebody who moves near the robot, in the frame of its odometry.
struct Person {
  std::uint32_t number = 0;  ///< The same one keeps it.
  Vec2 place{};              ///< [m]
  Vec2 velocity{};           ///< [m/s]
  double unseen = 0.0;       ///< [s] since a scan saw him; until now he has gone on as he went.
};

/// The manner in which the robot follows.
struct Manner {
  double distance = 0.0;   ///< [m] to keep, along the way that the person took.
  double max_speed = 0.0;  ///< [m/s]
  double search = 0.0;     ///< [s] of looking for somebody who is out of sight.
};

/// The result of one lap.
struct Step {
  enum class Kind { nobody, follows, searches, lost };
  Kind kind = Kind::nobody;
  double speed = 0.0;         ///< [m/s]
  double turn_rate = 0.0;     ///< [rad/s]
  std::optional<Vec2> aim{};  ///< [m] place that it drives to now.
};

/// The pursuit of a person on the way that he took, so that the robot passes doors as he did and cuts no corner. It takes who walks nearest before
/// it. If he gets out of sight it drives on to where he was seen last, and looks around there; somebody who appears near that place is taken for him.
///
/// Thread contract: as for a container.
class Pursuit {
 public:
  /// Goes on for one lap.
  /// @param people  who moves now; the same call with nobody is right where no scan has come.
  /// @param time [s]  of a clock that only advances.
  [[nodiscard]] Step step(const Pose2& robot, std::span<const Person> people, double time,
                          const Manner& manner);
  /// Forgets everybody.
  void clear() { *this = {}; }

 private:
  struct Target {
    Person person;
    double seen_at = 0.0;  // [s]
  };

  [[nodiscard]] const Person* find(const Pose2& robot, std::span<const Person> people, double time,
                                   const Manner& manner) const;
  void extend(Vec2 place);
  void go_on();
  void shorten(const Pose2& robot);
  [[nodiscard]] double way_left(const Pose2& robot) const;
  [[nodiscard]] Step drive(const Pose2& robot, double speed) const;
  [[nodiscard]] Step look_around(const Pose2& robot) const;

  std::optional<Target> target_;
  std::vector<Vec2> trail_;  // [m] where he was, the oldest first; the last one is where he was seen last
  bool went_on_ = false;     // or where he would be now, if he has gone on
};

}  // namespace orca::follow
