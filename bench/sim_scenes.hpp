// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "orca/sim/caster.hpp"
#include "orca/sim/robot_model.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::bench {

/// Returns a world of 200 turned boxes and four walls in 30 x 20 m.
sim::WorldModel two_hundred_boxes();

/// Returns the cave of the Stage simulator, 16 m wide, if its picture is there: in ORCA_DATA or
/// ../shared/data.
std::optional<sim::WorldModel> cave();

/// Returns a robot like the Nomad Scout, whose 16 sonars fire within 100 ms.
sim::RobotModel scout();

/// A fan of 361 laser beams over 180 degrees, up to 8 m.
class Fan {
 public:
  static constexpr std::size_t kBeams = 361;
  static constexpr double kRange = 8.0;   // [m]
  static constexpr double kHeight = 0.3;  // [m]
  Fan();
  /// Returns the ranges [m] of all beams from `X_WS`; they pass through `own_body`.
  [[nodiscard]] std::array<double, kBeams> cast(const sim::Caster& caster, const Pose2& X_WS,
                                                std::size_t own_body = static_cast<std::size_t>(-1)) const;
  /// Returns the ray of one beam.
  [[nodiscard]] sim::Ray ray(std::size_t beam, const Pose2& X_WS) const;

 private:
  std::array<Vec2, kBeams> directions_;  // In the sensor's frame.
};

}  // namespace orca::bench
