// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/hw/base_odometry.hpp"
#include "orca/hw/base_senses.hpp"
#include "orca/hw/nomad_scout/state.hpp"

namespace orca::hw::nomad_scout {

inline constexpr double kRadius = 0.19;         ///< [m] of the body, as in sim/robots/nomad_scout.urdf.
inline constexpr double kBumperRadius = 0.205;  ///< [m] of the bumpers, as there.
inline constexpr Duration kPeriod = 50ms;       ///< From state to state, on a line that is fast enough.

/// What a Scout senses of itself and around it, as endpoints: odometry, sonars, bumpers, battery.
///
/// Which bumper switch has which bit is not documented. They are counted like the sonars, from ahead to the left. A switch that is
/// touched in motion is taken to lie where the robot drives to, whatever its number.
///
/// Thread contract: not synchronised; the container's strand.
class ScoutSenses {
 public:
  /// @param track  [m] between the wheels.
  /// @param cycle  [s] in which all sonars fire once.
  ScoutSenses(double track, Duration cycle, const SenseTraits& traits);

  [[nodiscard]] std::vector<SensorEndpoint*> endpoints();
  [[nodiscard]] idl::SonarRing describe_sonars() const;

  /// Begins anew with a robot. The pose goes on from where it was.
  void connect();

  /// Notes that the sonars are told to fire. Until each has, their ranges say nothing and are not published.
  void await_sonars(TimePoint now) { sonars_.await_round(now); }

  /// Takes a state.
  /// @param stamp    when the robot sent it.
  /// @param forward  [m/s] that the wheels are told.
  void take(const State& state, TimePoint stamp, double forward);
  /// Publishes what the last state told. @pre  take() was called.
  void publish();

  /// Returns the bumpers that are pressed, for MotionHW::press().
  [[nodiscard]] std::vector<Obstruction::Pressed> pressed() const { return bumpers_.pressed(); }
  /// Returns whether the wheels turn.
  [[nodiscard]] bool moves() const { return !(state_.speeds == Wheels{}); }
  /// Returns whether the controller's clock has gone back: it was switched off and on.
  [[nodiscard]] bool has_restarted(const State& next) const;

 private:
  const double track_;
  BaseOdometry odometry_;
  BaseSonars sonars_;
  BaseBumpers bumpers_;
  SensorHW<idl::Battery> battery_;

  CountedPose counted_{kCoordinates};
  State state_;  // the last one
  TimePoint stamp_{};
};

}  // namespace orca::hw::nomad_scout
