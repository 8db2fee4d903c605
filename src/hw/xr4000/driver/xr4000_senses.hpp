// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "orca/geometry/twist2.hpp"
#include "orca/hw/base_odometry.hpp"
#include "orca/hw/base_senses.hpp"
#include "orca/hw/xr4000/answers.hpp"
#include "orca/hw/xr4000/base.hpp"

namespace orca::hw::xr4000 {

inline constexpr double kBodyRadius = 0.31;  ///< [m] with the bumpers, an estimate: the sonars sit on 0.3 m.
inline constexpr Duration kReadingPeriod = 50ms;  ///< From state to state, and so for sonars and bumpers.
inline constexpr Duration kBatteryPeriod = 10s;   ///< From reading to reading of the batteries.

/// What an XR4000 senses of itself and around it, as endpoints: odometry, sonars, bumpers, and a battery if its scale is known.
///
/// Where on its door a bumper switch sits is not public. One that is touched in motion is taken to lie where the robot drives to,
/// and another one in the middle of its door.
///
/// Thread contract: not synchronised; the container's strand.
class XrSenses {
 public:
  /// Which of the battery's channels is reported, and how.
  struct BatteryScale {
    double volts_per_count = 0.0;  ///< [V] 0: not known; no battery is reported.
    std::size_t channel = 0;       ///< Of the four.
  };

  /// @param cycle  [s] in which all sonars fire once.
  XrSenses(Duration cycle, const BatteryScale& scale, const SenseTraits& traits);

  [[nodiscard]] std::vector<SensorEndpoint*> endpoints();

  /// Returns what the sonars are, for clients that ask what the robot has.
  [[nodiscard]] idl::SonarRing describe_sonars() const;

  /// Begins anew with a robot. The pose goes on from where it was.
  void connect();

  /// Takes a state. @param stamp  when the agent sent it.
  void take(const State& state, TimePoint stamp);
  /// Publishes the odometry of the last state.
  void publish_state();
  /// Takes the answer to get_sonar, get_bumper or get_battery; others are ignored.
  /// @param stamp      when the agent sent it.
  /// @param told       velocity that the robot is told.
  /// @param publishes  whether somebody uses the readings.
  /// @errors  those of the functions that parse it.
  Status take(const Message& answer, TimePoint stamp, const Twist2& told, bool publishes);

  [[nodiscard]] bool has_battery() const { return scale_.volts_per_count > 0.0; }
  /// Returns the bumpers that are pressed, for MotionHW::press().
  [[nodiscard]] std::vector<Obstruction::Pressed> pressed() const { return bumpers_.pressed(); }
  /// Returns whether the axes move.
  [[nodiscard]] bool moves() const { return !(state_.speeds == Axes{}); }
  /// Returns the bits of the axes' status.
  [[nodiscard]] std::uint8_t status() const { return state_.status; }
  /// Returns whether the robot's clock has gone back: it was switched off and on.
  [[nodiscard]] bool has_restarted(const State& next) const;

 private:
  void take_touches(const BumperReadings& readings, const Twist2& told);

  const BatteryScale scale_;
  BaseOdometry odometry_;
  BaseSonars sonars_;
  BaseBumpers bumpers_;
  SensorHW<idl::Battery> battery_;

  IntegratorOdometry integrator_;
  State state_;  // the last one
  TimePoint stamp_{};
};

}  // namespace orca::hw::xr4000
