// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/geometry/objects/odometry.hpp"
#include "orca/hw/endpoints.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"
#include "shared_world.hpp"

namespace orca::sim {

/// The sensor endpoints of a simulated robot: one per device that its file lists, and one for its true pose.
///
/// Thread contract: one strand.
class SimSensors {
 public:
  /// @param realism  level of the world's realism, for which the robot's file may have guesses of errors of its own.
  SimSensors(const RobotModel& robot, Realism realism);

  /// Returns the endpoints kind by kind, in the order of the robot's file.
  [[nodiscard]] std::vector<hw::SensorEndpoint*> endpoints();

  /// Publishes the readings through the endpoints.
  void publish(const SharedWorld::Inbox& inbox);

  /// Takes notice of readings that nobody wants: the odometry goes on.
  void skip(const SharedWorld::Inbox& inbox);

 private:
  /// A device of the robot's file with its endpoint.
  template <class Object, class Model>
  struct Device {
    Device(const Model& made, std::string name)
        : model(made), endpoint(made.period, hw::Source::sensor, std::move(name)) {}
    const Model model;
    hw::SensorHW<Object> endpoint;
  };
  template <class Object, class Model>
  using Devices = std::vector<std::unique_ptr<Device<Object, Model>>>;

  const Realism realism_;
  Devices<idl::SonarRangeReadings, SonarRing> sonars_;
  Devices<idl::LaserRangeReadings, LaserScanner> lasers_;
  Devices<idl::InfraredRangeReadings, InfraredRing> infrareds_;
  Devices<idl::BumperReadings, BumperRing> bumpers_;
  Devices<idl::Image, Camera> cameras_;
  std::unique_ptr<hw::SensorHW<idl::Odometry>> odometry_;
  std::optional<OdometryUncertainty> uncertainty_;
  std::unique_ptr<hw::SensorHW<idl::TurretAngle>> turret_;
  std::unique_ptr<hw::SensorHW<idl::GripperState>> gripper_;
  std::unique_ptr<hw::SensorHW<idl::Battery>> battery_;
  hw::SensorHW<idl::RobotPose> truth_{kTruthPeriod, hw::Source::truth};
};

}  // namespace orca::sim
