// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"
#include "sonar_air.hpp"
#include "tick_span.hpp"

namespace orca::sim::detail {

// A sonar ring whose transducers fire evenly over its period, one after the other or some at once. All rings
// of a world send before any of them listens, so that each hears the others.
class SonarModel {
 public:
  SonarModel(SonarRing ring, const ErrorLevels& errors, RandomStream random, TimePoint start);

  // Fires the transducers that are due in the span, and finds their own echoes.
  void fire(const Caster& caster, std::size_t own_body, const TickSpan& span);
  // Sends the chirps fired, so that other sonars can hear them.
  void send(SonarAir& air);
  // Turns the first sound that each transducer hears into its reading.
  void listen(const Caster& caster, const SonarAir& air);

  // Returns the round that was completed in the last listen(), if one was.
  [[nodiscard]] const std::optional<SonarScan>& completed() const { return completed_; }

 private:
  struct Shot {
    std::size_t transducer = 0;
    bool is_dead = false;
    TimePoint time;
    std::optional<Beam> beam;
    Pose2 X_RB;               // Pose of frame B in the robot's frame.
    Pose2 X_RS;               // Pose of the transducer in the robot's frame.
    Echo echo;                // The transducer's own echo.
    std::uint64_t chirp = 0;  // Number of the chirp, valid once it is sent.
  };

  [[nodiscard]] TimePoint next_due() const;
  [[nodiscard]] Shot& next_shot();
  [[nodiscard]] std::span<Shot> shots() { return {shots_.data(), shot_count_}; }
  [[nodiscard]] std::optional<double> heard(const Shot& shot, const Caster& caster, const SonarAir& air);
  [[nodiscard]] SonarReading measured(std::optional<double> echo);

  SonarRing ring_;
  std::vector<Pose2> transducers_;  // Poses in the frame of the ring's carrier.
  std::vector<bool> dead_;          // Transducers that are silent in this run.
  Lobe lobe_;
  ErrorLevels errors_;
  double critical_tangent_;
  RandomStream random_;
  TimePoint round_start_;
  std::size_t fired_ = 0;     // Transducers that have fired in the present round.
  std::size_t listened_ = 0;  // Transducers that have listened in the present round.
  std::vector<Shot> shots_;   // The first shot_count_ are this tick's; the others keep their memory.
  std::size_t shot_count_ = 0;
  Sectors::Search search_;
  SonarScan scan_;
  std::optional<SonarScan> completed_;
};

}  // namespace orca::sim::detail
