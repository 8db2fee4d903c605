// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"
#include "slip_process.hpp"

namespace orca::sim::detail {

// How one robot's wheels differ from the dimensions that its controller assumes.
struct WheelErrors {
  // Relative errors of the true diameters. A differential base has two wheels, left and right; the other kinds
  // have three.
  std::array<double, 3> diameter{};
  double track = 0.0;  // Relative error: the true track is (1 + track) times the assumed one.
  // [m] Standard deviation of a wheel's way over the floor per root of a metre that it rolls, on long ways.
  double slip = 0.0;
  double turn_slip = 0.0;  // [m] The same per root of a radian that the base turns, in addition.
  double slip_length =
      0.1;  // [m] Way over which the wheel's slip keeps its ratio: integral of its correlation.
  double common_slip = 0.0;    // [m] Slip of all wheels in common, per root of a metre that the base drives.
  double common_length = 1.0;  // [m] As slip_length, of common_slip.
  double slip_angle = 0.2;     // [rad] The same of turn_slip.

  // Draws the errors of one robot. The largest ratio of two diameters lies within the bound of the level. The
  // diameters of a differential base are drawn by their ratio and their mean, so that they are uncorrelated. The mean
  // of three wheels lies within its bound, too: what their ratios leave of it is drawn for all of them.
  [[nodiscard]] static WheelErrors drawn(DriveKind kind, const ErrorLevels& errors, RandomStream& random);
};

// What the floor does to the wheels in a tick.
struct Footing {
  double slip = 1.0;             // Factor on the standard deviation of slip.
  std::array<double, 3> lost{};  // [m] By which each wheel falls behind what it rolls.
};

// The wheels of a base, between what their encoders count and what the base does. The controller regulates the
// wheels by their encoders, with the assumed dimensions. So the errors of the wheels act on the true motion.
class WheelModel {
 public:
  WheelModel(const Drive& drive, const WheelErrors& errors);

  // Returns the true motion of a base whose wheels roll so that their encoders report `rolled`. It draws the
  // slip of this tick.
  // @param steering [rad]  direction in which the wheels of a synchro base roll, relative to its body. The
  //        turn of the result contains that of the body, which no encoder sees.
  Travel2 over_ground(const Travel2& rolled, double steering, const Footing& footing, RandomStream& random);

  // Returns what the encoders report if the base moved by `real` in this tick instead, with the same slip.
  // Sideways motion turns only the wheels of a holonomic base. The steering of a synchro base is not seen here.
  [[nodiscard]] Travel2 rolled(const Travel2& real) const;

  // Returns where the wheels touch the floor, in the frame of the body.
  [[nodiscard]] std::vector<Vec2> places() const;

 private:
  using Ways = std::array<double, 3>;  // [m] of the wheels

  void draw_slip(const Travel2& base, const Ways& rolled, const Footing& footing, RandomStream& random);
  [[nodiscard]] std::size_t wheels() const { return kind_ == DriveKind::differential ? 2 : 3; }
  [[nodiscard]] double true_track() const { return track_ * (1.0 + errors_.track); }
  [[nodiscard]] Ways ways_of(const Travel2& base, double track) const;
  [[nodiscard]] Travel2 base_of(const Ways& ways, double track) const;

  DriveKind kind_;
  WheelErrors errors_;
  double track_;
  // Each wheel's slip by what it rolls, and by the turn of the base.
  std::vector<SlipProcess> rolling_, turning_;
  SlipProcess common_;  // Of all wheels by what the base drives.
  Ways slip_{};         // In the present tick.
};

}  // namespace orca::sim::detail
