// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/base/random.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// The cone of one transducer at the moment it fires.
struct Beam {
  Pose2 sensor;            // In the world.
  double half_lobe = 0.0;  // [rad]
  double max_range = 0.0;  // [m]
  double height = 0.0;     // [m]
  std::size_t own_body = 0;
};

// The distance from which the first echo comes back [m], without noise; nothing if none is strong enough.
[[nodiscard]] std::optional<double> first_echo(const Caster& caster, const Beam& beam, double critical_angle);

// A ring whose transducers fire one after the other, evenly over its period.
class SonarModel {
 public:
  SonarModel(SonarRing ring, const ErrorLevels& errors, RandomStream random, TimePoint start);

  // Fires everything due in (from, to], while the robot moves from X_from to X_to.
  struct Span {
    TimePoint from, to;
    Pose2 X_from, X_to;
  };
  void run(const Caster& caster, std::size_t own_body, const Span& span);

  // The round that was completed in the last run(), if one was.
  [[nodiscard]] const std::optional<SonarScan>& completed() const { return completed_; }

 private:
  void fire(const Caster& caster, std::size_t own_body, const Pose2& X_WB, TimePoint stamp);
  [[nodiscard]] SonarReading measured(std::optional<double> echo);
  [[nodiscard]] TimePoint next_due() const;

  SonarRing ring_;
  ErrorLevels errors_;
  RandomStream random_;
  TimePoint round_start_;
  std::size_t fired_ = 0;  // In the present round.
  SonarScan scan_;
  std::optional<SonarScan> completed_;
};

}  // namespace orca::sim::detail
