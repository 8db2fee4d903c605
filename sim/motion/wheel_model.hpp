// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>

#include "orca/base/random.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// The differences between one robot's wheels and the dimensions that its odometry assumes.
struct WheelErrors {
  // Relative errors of the diameters. A differential base has two, left and right; the other kinds have
  // three.
  std::array<double, 3> diameter{};
  double track = 0.0;  // Relative error: the odometry calculates with (1 + track) times the true track.
  double slip = 0.0;   // [m] Standard deviation of a wheel's measured travel after 1 m; grows with its root.

  // Draws the errors of one robot.
  [[nodiscard]] static WheelErrors drawn(DriveKind kind, const ErrorLevels& errors, RandomStream& random);
};

// The motion that the encoders report for a true motion. Each wheel's travel has its own diameter error and
// slip; the robot's (wrong) dimensions combine the travels again. A sideways push turns only the wheels of a
// holonomic base.
class WheelModel {
 public:
  WheelModel(const Drive& drive, const WheelErrors& errors)
      : kind_(drive.kind), errors_(errors), track_(drive.track) {}

  [[nodiscard]] Travel2 measured(const Travel2& real, RandomStream& random) const;

 private:
  [[nodiscard]] double wheel(std::size_t number, double travel, RandomStream& random) const;
  [[nodiscard]] Travel2 differential(const Travel2& real, RandomStream& random) const;
  [[nodiscard]] Travel2 synchro(const Travel2& real, RandomStream& random) const;
  [[nodiscard]] Travel2 holonomic(const Travel2& real, RandomStream& random) const;

  DriveKind kind_;
  WheelErrors errors_;
  double track_;
};

}  // namespace orca::sim::detail
