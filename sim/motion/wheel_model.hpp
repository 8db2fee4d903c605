// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>

#include "orca/base/random.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// How far the wheels of one robot are from what its odometry takes them for.
struct WheelErrors {
  // Relative, of the diameter. Differential: left and right; the others have three.
  std::array<double, 3> diameter{};
  double track = 0.0;  // Relative: the odometry calculates with (1 + track) times the true one.
  double slip = 0.0;   // [m] Deviation of a wheel's measured travel after 1 m; grows with its root.

  // What this robot got.
  [[nodiscard]] static WheelErrors drawn(DriveKind kind, const ErrorLevels& errors, RandomStream& random);
};

// What the encoders make of a true motion: the travel of each wheel with its own wrong diameter and slip, put
// together again by the robot's (wrong) dimensions. Being pushed sideways turns no wheel but a holonomic
// base's.
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
