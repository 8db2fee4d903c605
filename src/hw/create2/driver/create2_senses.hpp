// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/hw/base_odometry.hpp"
#include "orca/hw/base_senses.hpp"
#include "orca/hw/create2/sensors.hpp"

namespace orca::hw::create2 {

inline constexpr double kRadius =
    0.174;  ///< [m] of the body with its bumper. A measured figure of users; no manual has it.
inline constexpr int kFramesPerReading = 3;
inline constexpr Duration kPeriod = 45ms;  ///< Between two readings: so many frames.

/// What a Create 2 senses of itself and around it, as endpoints: odometry, bumpers, battery.
///
/// Thread contract: not synchronised; the container's strand.
class Create2Senses {
 public:
  explicit Create2Senses(const SenseTraits& traits);

  [[nodiscard]] std::vector<SensorEndpoint*> endpoints() {
    return {&odometry_.endpoint(), &battery_, &bumpers_.endpoint()};
  }

  /// Begins anew with a robot. The pose goes on from where it was.
  void connect();
  /// Takes a frame.
  /// @param stamp  when the robot sent it.
  void take(const Sensors& sensors, TimePoint stamp);
  /// Publishes what the frames have told since the last time, after every third one.
  void publish();

  /// Returns the bumpers and cliffs, for MotionHW::press(): where the robot must not go.
  [[nodiscard]] std::vector<Obstruction::Pressed> pressed() const;
  /// Returns what is to be said of the battery now; empty: nothing.
  [[nodiscard]] std::string take_remark() { return charge_.take_remark(); }
  /// Returns the last frame.
  [[nodiscard]] const Sensors& sensors() const { return sensors_; }

 private:
  void publish_odometry();
  void publish_battery();

  BaseOdometry odometry_;
  BaseBumpers bumpers_;
  SensorHW<idl::Battery> battery_;
  ChargeWatch charge_;

  EncoderOdometry wheels_;
  Pose2 pose_;                      // in the frame of the odometry
  Travel2 travel_{};                // since the last reading
  std::optional<TimePoint> since_;  // the last reading
  int frames_ = 0;                  // since then
  Sensors sensors_;                 // the last frame
  TimePoint stamp_{};
};

}  // namespace orca::hw::create2
