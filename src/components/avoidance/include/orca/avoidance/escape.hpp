// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "orca/avoidance/seen_floor.hpp"
#include "orca/base/time.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/navigation/retreat.hpp"

namespace orca::avoid {

/// The way out for a robot that stands for a second although it has somewhere to go: it has met something that its sensor does not
/// see, or has come so near to something that it can neither drive on nor turn with the usual margins. It retreats by 0.1 m, or,
/// where no way is known, turns towards its goal as far as its exact outline finds room. It does so once, until it has moved on.
///
/// Thread contract: one thread at a time.
class Escape {
 public:
  /// The facts of a moment.
  struct Moment {
    TimePoint now;
    Pose2 pose;                    ///< In a frame that does not move, as that of the odometry.
    Twist2 twist;                  ///< The robot's.
    std::optional<double> goal;    ///< [rad] robot frame; nothing: it has nowhere to go.
    std::span<const Vec2> echoes;  ///< Robot frame.
    const SeenFloor& floor;        ///< In the frame of the pose.
  };

  explicit Escape(const nav::Footprint& outline) : outline_(outline), retreat_(outline) {}

  /// Returns the motion of the next moment; nothing as long as the robot gets on by itself.
  [[nodiscard]] std::optional<nav::Steer> step(const Moment& moment);
  /// Returns whether the step that was returned last is the first one of a way out.
  [[nodiscard]] bool has_just_begun() const { return has_just_begun_; }

 private:
  [[nodiscard]] bool is_stuck(const Moment& moment);
  [[nodiscard]] nav::Steer way_out(const Moment& moment);
  [[nodiscard]] bool is_done(const nav::Steer& steer, const Moment& moment) const;

  nav::Footprint outline_;
  nav::Retreat retreat_;
  std::optional<TimePoint> since_;  // it is on a way out
  Pose2 from_;                      // where it began
  std::optional<Pose2> ended_at_;   // where the last one ended, until it has moved on
  std::optional<TimePoint> stands_since_;
  bool has_just_begun_ = false;
};

}  // namespace orca::avoid
