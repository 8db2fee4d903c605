// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "orca/geometry/error_guess.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/idl/hardware.hpp"

namespace orca {

/// The uncertainty of a pose that a base computes from the turns of its wheels, since the start of the odometry. A driver
/// feeds it with the poses that the base reports; it needs no readings of single wheels.
///
/// Slip is new in each step. Errors of wheels and track stay the same, so their effects add up along the way: they are
/// unknown parameters of the run, whose influence on the pose is carried along. docs/geometry.md has the equations.
///
/// Thread contract: not synchronised; one strand.
/// @source  K. S. Chong and L. Kleeman, "Accurate odometry and error modelling for a mobile robot", ICRA 1997, for the
///          error of a wheel; J. Borenstein and L. Feng, "Measurement and correction of systematic odometry errors in
///          mobile robots", IEEE Trans. Robotics and Automation 12(6), 1996, for the errors of wheels and track.
class OdometryUncertainty {
 public:
  /// @param type   how the wheels work together. A synchro or holonomic base has three of them, at 60, 180 and 300 deg.
  /// @param track [m]  diameter of the circle through the points where the wheels touch the floor, > 0.
  /// @param guess  of the wheels' errors; nothing negative.
  OdometryUncertainty(idl::DriveType type, double track, const WheelErrorGuess& guess);

  /// Continues to the next pose that the base reports. It has moved there along an arc.
  /// @param X_OR  pose of the robot in the frame of its odometry. At the start it is that frame.
  /// @pre  the base turned by less than half a circle since the last pose.
  void move_to(const Pose2& X_OR);

  /// Returns the covariance of x, y and orientation [m2, m rad, rad2], row by row, to first order. All zero: not known.
  [[nodiscard]] std::array<double, 9> covariance() const;

 private:
  // A wheel, by what it measures and by what its errors do to the travel that the base reports.
  struct Wheel {
    Vec2 rolls;         // direction in which it rolls when the base moves straight, seen from the robot
    double lever;       // [m] of its travel per turn of the base
    Travel2 per_metre;  // added to the travel by a metre that a wrong diameter or slip adds to this wheel's
    Vec2 twist;  // [1/m] turn of a synchro base's body by the same metre, per direction in which it rolls
    // Returns the effect of that metre while the wheels of a synchro base roll in a direction [rad] seen from its body.
    [[nodiscard]] Travel2 effect(double steering) const {
      return {per_metre.forward, per_metre.left, per_metre.turn + dot(twist, direction(steering))};
    }
    [[nodiscard]] double travel(const Travel2& base) const {
      return dot(rolls, {base.forward, base.left}) + lever * base.turn;
    }
  };
  static constexpr int kErrors = 4;  // constant errors: of up to three wheels, and of the track
  using Effect = std::array<double, 3 * kErrors>;

  [[nodiscard]] double slip_variance(double rolled, double turn) const;
  [[nodiscard]] static std::vector<Wheel> wheels_of(idl::DriveType type, double track);

  std::vector<Wheel> wheels_;
  WheelErrorGuess guess_;
  bool track_counts_;  // whether the reported turn depends on the track
  Pose2 X_OR_;
  std::array<double, 9> slip_{};  // covariance that slip has caused, row by row
  Effect effect_{};               // derivatives of x, y, orientation by the constant errors, row by row
};

}  // namespace orca
