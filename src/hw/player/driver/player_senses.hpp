// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/hw/base_odometry.hpp"
#include "orca/hw/base_senses.hpp"
#include "orca/hw/player/message.hpp"
#include "orca/hw/player/position2d.hpp"
#include "orca/hw/player/sensors.hpp"
#include "player_session.hpp"

namespace orca::hw::player {

/// What is not said over the line.
struct PlayerRobotShape {
  double radius = 0.0;       ///< [m] at which bumpers are taken to lie.
  double sonar_range = 0.0;  ///< [m] longest that a sonar hears.
};

/// What the devices of a Player server sense, as endpoints. Each is published as it comes, in active hardware.
///
/// Where bumpers lie is not said over the line. They are taken to lie evenly around the robot, counted from ahead to the left, and one that
/// is touched in motion to lie where the robot drives to.
///
/// Thread contract: not synchronised; the container's strand.
class PlayerSenses {
 public:
  /// @param uses  devices that are used.
  PlayerSenses(const std::vector<Use>& uses, const PlayerRobotShape& shape);

  [[nodiscard]] const std::vector<SensorEndpoint*>& endpoints() const { return endpoints_; }

  /// Begins anew with a robot. The pose of the odometry goes on from where it was.
  void connect(const PlayerRobotFacts& facts);
  /// Takes what the server has said later of the same robot.
  void learn(const PlayerRobotFacts& facts);

  /// Takes data. @return whether they have numbers that mean something.
  /// @param stamp    when they came.
  /// @param publish  whether they are passed on.
  bool take(const Position2dState& state, TimePoint stamp, bool publish);
  bool take(const SonarRanges& ranges, TimePoint stamp, bool publish);
  bool take(const LaserScan& scan, TimePoint stamp, bool publish);
  /// @param forward  [m/s] that the wheels are told.
  bool take(const BumperState& bumpers, double forward, TimePoint stamp, bool publish);
  bool take(const PowerState& power, TimePoint stamp, bool publish);

  /// Returns what is to be said of the battery now; empty: nothing.
  [[nodiscard]] std::string take_remark() { return charge_.take_remark(); }
  /// Returns the bumpers that are pressed, for MotionHW::press().
  [[nodiscard]] std::vector<Obstruction::Pressed> pressed() const { return bumpers_.pressed(); }

 private:
  const PlayerRobotShape shape_;
  BaseOdometry odometry_;
  BaseSonars sonars_;
  SensorHW<idl::LaserRangeReadings> laser_;
  BaseBumpers bumpers_;
  SensorHW<idl::Battery> battery_;
  ChargeWatch charge_;
  std::vector<SensorEndpoint*> endpoints_;

  PlayerRobotFacts facts_;
  Pose2 pose_;  // in the frame of the odometry
  std::optional<Pose2>
      server_zero_;  // where the server's odometry begins, in that frame; nothing: not heard yet
};

}  // namespace orca::hw::player
