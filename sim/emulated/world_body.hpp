// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "orca/emulators/body.hpp"
#include "orca/sim/robot_model.hpp"
#include "shared_world.hpp"
#include "stall_watch.hpp"

namespace orca::sim {

/// A robot of the simulated world as the firmware of its devices drives and senses it: they all see what it has sensed last.
///
/// Thread contract: one strand.
class WorldBody final : public emulators::Body, public emulators::Mirror {
 public:
  /// What moves the robot of the world.
  struct Motors {
    std::function<void(const Twist2&)> wheels;           ///< Gives the wheels a velocity.
    std::function<void(const GripperOrder&)> gripper{};  ///< Called only if the robot has a gripper.
  };

  /// @param robot  outlives the object.
  WorldBody(const RobotModel& robot, Motors motors);

  /// Takes what the robot has sensed since the last call.
  void sense(const SharedWorld::Inbox& inbox);

  void drive(const Twist2& velocity) override;
  [[nodiscard]] Pose2 odometry() const override { return odometry_.pose; }
  [[nodiscard]] Twist2 velocity() const override { return odometry_.velocity; }
  [[nodiscard]] std::optional<double> sonar(int number) const override;
  [[nodiscard]] std::uint16_t bumpers() const override { return bumpers_; }
  [[nodiscard]] bool is_stalled() const override { return stalled_; }
  void move_gripper(emulators::GripperMove move) override;
  [[nodiscard]] std::optional<emulators::GripperLook> gripper() const override;
  [[nodiscard]] std::optional<double> battery_voltage() const override { return battery_voltage_; }
  [[nodiscard]] std::optional<bool> is_charged() const override { return is_charged_; }
  [[nodiscard]] std::optional<emulators::MirrorTurn> last_turn() const override;

 private:
  void hear(const SonarScan& scan);
  void feel(const BumperRing& ring, const BumperReading& reading);
  void see(LaserScan scan);

  const RobotModel& robot_;
  const Motors motors_;
  StallWatch stall_;
  OdometryReading odometry_{};
  std::vector<std::optional<double>> sonars_;  // [m] nothing: no echo
  std::uint16_t bumpers_ = 0;
  bool stalled_ = false;
  std::optional<LaserScan> scan_;
  std::optional<GripperReading> gripper_;  // the last one
  std::optional<double> battery_voltage_;  // [V]
  std::optional<bool> is_charged_;
};

}  // namespace orca::sim
