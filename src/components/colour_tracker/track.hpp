// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/geometry/vec2.hpp"

namespace orca::colour {

/// Something that moves and is seen now and then, in a frame that stands still: a Kalman filter of constant velocity, the same for both axes.
///
/// Thread contract: as for a container.
/// @source  Bar-Shalom, Li and Kirubarajan, "Estimation with Applications to Tracking and Navigation", 2001, ch. 6.3 (piecewise constant acceleration).
class Track {
 public:
  static constexpr double kDoubt = 0.5;  ///< [s]
  static constexpr double kUnseen =
      2.0;  ///< [s] Out of sight it goes on as it went for so long, and is then forgotten.

  /// Takes a sighting at a place.
  /// @param error [m]  standard deviation of the place in each direction.
  /// @param time [s]   of a clock that only advances.
  void see(Vec2 place, double error, double time);
  /// Returns whether somebody who was where the track says may be there now: a sighting that is hidden in part is far off. The track believes in
  /// its place as long as it was confirmed within kDoubt.
  [[nodiscard]] bool admits(Vec2 place, double error) const;
  /// Goes on to a time without a sighting.
  void miss(double time);
  void clear() { *this = {}; }

  [[nodiscard]] bool is_there() const { return begun_; }
  [[nodiscard]] double time() const { return time_; }  ///< [s] As of which the rest is.
  [[nodiscard]] Vec2 place() const { return place_; }
  [[nodiscard]] Vec2 velocity() const { return velocity_; }
  [[nodiscard]] double place_error() const;                         ///< [m]
  [[nodiscard]] double velocity_error() const;                      ///< [m/s]
  [[nodiscard]] double unseen() const { return time_ - seen_at_; }  ///< [s]

 private:
  void advance(double time);

  bool begun_ = false;
  Vec2 place_, velocity_;
  double variance_ = 0.0;  // [m2] of the place,
  double covariance_ = 0.0;
  double velocity_variance_ = 0.0;
  double time_ = 0.0, seen_at_ = 0.0;
};

}  // namespace orca::colour
