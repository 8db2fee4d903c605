// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <string>

#include "orca/hw/endpoints.hpp"
#include "orca/hw/scene.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/sim/world.hpp"
#include "shared_world.hpp"

namespace orca::sim {

/// Fills the framework's objects with what the simulator measured.
void fill(idl::SonarRangeReadings& object, const SonarScan& scan, const SonarRing& ring);
void fill(idl::LaserRangeReadings& object, const LaserScan& scan, const LaserScanner& laser);
void fill(idl::InfraredRangeReadings& object, const InfraredScan& scan, const InfraredRing& ring);
void fill(idl::BumperReadings& object, const BumperReading& reading, const BumperRing& ring);
void fill(idl::Image& object, const CameraShot& shot, const Camera& camera);
/// @param covariance [m2, m rad, rad2]  of x, y and orientation, row by row; all zero: not known.
void fill(idl::Odometry& object, const OdometryReading& reading, const std::array<double, 9>& covariance);
void fill(idl::TurretAngle& object, const TurretReading& reading);
void fill(idl::GripperState& object, const GripperReading& reading);
void fill(idl::Battery& object, const BatteryReading& reading);
void fill(idl::RobotPose& object, const SharedWorld::Inbox::Truth& truth);

/// Returns the readings of sensors without a robot, in whose frame nobody lives: seen from the world's.
/// @param X_WF  where they are fixed.
[[nodiscard]] SharedWorld::Inbox in_world(SharedWorld::Inbox inbox, const Pose2& X_WF);

/// Returns the framework's word for a kind of drive.
[[nodiscard]] idl::DriveType type_of(DriveKind kind);

/// Returns what a command asks of the simulated gripper.
[[nodiscard]] GripperOrder order_of(const idl::GripperCommand& command);

/// Returns the limits of the commands that the robot's base accepts.
[[nodiscard]] hw::DriveLimits limits_of(const RobotModel& robot);

/// Returns the description of the robot that its clients can query.
[[nodiscard]] idl::Robot describe(const RobotModel& model, const std::string& name);

/// Fills in whose device it is, and what drives it here.
/// @tparam Object  a Sensor or an Actuator.
template <class Object>
void label(Object& object, const DeviceLabel& label) {
  object.vendor(label.vendor);
  object.model(label.model);
  object.port(label.port);
  object.library("sim.so");
  object.driver("orca.hw.Sim");
}

/// Adds the sensors to the robot's description.
void describe_sensors(const RobotModel& model, idl::Robot& robot);

/// Adds the robot of that name to the scene, and the walls and places if no other robot of the same world has added
/// them.
void draw(const Snapshot& from, const std::string& name, const RobotModel& model,
          std::vector<Scene::Moment> moments, std::vector<Scene::Step> motion,
          std::vector<Scene::Encounter> encounters, Scene& to);

/// Adds the robot where it starts, and the places of its world if no other robot has added any. For runs that have not begun.
void draw_start(const WorldModel& world, const std::string& name, const RobotModel& model, const Pose2& start,
                Scene& to);

}  // namespace orca::sim
