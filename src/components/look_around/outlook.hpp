// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "orca/avoidance/advice.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::look {

/// All that is seen from a place: the nearest echo in each direction, in a frame that does not move.
///
/// A plain value.
struct Panorama {
  static constexpr std::size_t kDirections = 72;
  static constexpr double kFar = 5.0;  ///< [m] Echoes farther away do not count.

  Vec2 from;
  std::array<double, kDirections> ranges{};  ///< [m] kFar where nothing is.
  std::vector<Vec2> echoes;

  /// @param echoes  robot frame; all around.
  Panorama(const Pose2& X_OR, std::span<const Vec2> echoes);
  /// Returns whether a place is seen.
  [[nodiscard]] bool shows(Vec2 place) const;
};

/// Returns how much is seen from a place that no panorama shows, of 16 directions.
[[nodiscard]] int news_at(Vec2 place, std::span<const Panorama> seen);

/// The limits of a look around.
struct Limits {
  avoid::Limits body;      ///< The robot's, and those of its way.
  double turn_rate = 1.0;  ///< [rad/s] of turns on the spot.
};

/// The knowledge of a robot as it looks around. A plain value.
struct Moment {
  double time = 0.0;  ///< [s] from any beginning.
  Pose2 X_OR;         ///< In a frame that does not move, such as the odometry's.
  avoid::Situation situation;
  std::span<const Vec2> echoes;  ///< Robot frame.
};

/// A robot's way to other views, so that its localizer learns which of several places it is at: it turns half round on the spot, drives straight
/// to where most is seen that it has not seen yet, turns again, and so on. See README.md.
///
/// Thread contract: one thread at a time.
class Outlook {
 public:
  /// Begins again where the robot is.
  void reset();
  /// Returns what the robot is to do now; nothing if it cannot move anywhere.
  [[nodiscard]] std::optional<avoid::Advice> step(const Moment& moment, const Limits& limits);

 private:
  struct Turn {
    double last_yaw = 0.0;
    double turned = 0.0;  // [rad]
    double side = 0.0;    // +1 or -1; 0: it has not begun
  };
  // In the frame of X_OR.
  struct Leg {
    Vec2 to;
    double nearest = 0.0;    // [m] that the robot came to it
    double got_on_at = 0.0;  // [s] when it came nearer last
  };

  [[nodiscard]] std::optional<avoid::Advice> turn(const Moment& moment, const Limits& limits);
  [[nodiscard]] std::optional<avoid::Advice> drive(const Moment& moment, const Limits& limits);
  [[nodiscard]] std::optional<Leg> next_leg(const Moment& moment, const Limits& limits) const;

  Turn turn_;
  std::optional<Leg> leg_;  // nothing: it turns
  std::vector<Panorama> seen_;
};

}  // namespace orca::look
