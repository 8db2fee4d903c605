// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/tracking/walk_estimate.hpp"

namespace orca::colour {

/// Somebody who is seen now and then, in a frame that stands still.
///
/// Thread contract: as for a container.
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
  [[nodiscard]] Vec2 place() const { return walk_.place; }
  [[nodiscard]] Vec2 velocity() const { return walk_.velocity; }
  [[nodiscard]] double place_error() const { return walk_.place_error(); }        ///< [m]
  [[nodiscard]] double velocity_error() const { return walk_.velocity_error(); }  ///< [m/s]
  [[nodiscard]] double unseen() const { return time_ - seen_at_; }                ///< [s]

 private:
  void advance(double time);

  bool begun_ = false;
  tracking::WalkEstimate walk_;
  double time_ = 0.0, seen_at_ = 0.0;
};

}  // namespace orca::colour
