// SPDX-License-Identifier: LGPL-3.0-or-later
#include "objects.hpp"
#include "orca/geometry/objects/plane.hpp"

namespace orca::sim {
namespace {

// Returns a description with the parts that all sensors have in common.
template <class Object, class Device>
Object named(const Device& device, const std::string& name, const char* type) {
  Object object;
  object.name(name);
  label(object, device.label);
  object.type(type);
  object.update_interval(to_seconds(device.period));
  return object;
}

idl::SonarRing describe(const SonarRing& ring) {
  auto object = named<idl::SonarRing>(ring, ring.name, "SonarRangeReadings");
  object.number(static_cast<std::uint32_t>(ring.count));
  object.dphi(ring.pitch);
  object.angle_sonar0(ring.angles.empty() ? ring.first_angle : ring.angles.front());
  object.radius(ring.positions.empty() ? ring.radius : 0.0);
  object.half_lobe(ring.half_lobe);
  object.scale_factor(ring.quantum);
  object.offset(ring.offset);
  object.min_range(ring.min_range);
  object.max_range(ring.max_range);
  return object;
}

idl::LaserSensor describe(const LaserScanner& laser) {
  auto object = named<idl::LaserSensor>(laser, laser.name, "LaserRangeReadings");
  object.mount(level_frame(laser.center, laser.height));
  object.number(static_cast<std::uint32_t>(laser.count));
  object.angle_start(laser.first_angle);
  object.angle_increment(laser.pitch);
  object.min_range(laser.min_range);
  object.max_range(laser.max_range);
  return object;
}

}  // namespace

void describe_sensors(const RobotModel& model, idl::Robot& robot) {
  for (const SonarRing& ring : model.sonars) robot.sonar_rings().push_back(describe(ring));
  for (const LaserScanner& laser : model.lasers) robot.laser_sensors().push_back(describe(laser));
  for (const InfraredRing& ring : model.infrareds)
    robot.sensors().push_back(named<idl::Sensor>(ring, ring.name, "InfraredRangeReadings"));
  for (const BumperRing& ring : model.bumpers)
    robot.sensors().push_back(named<idl::Sensor>(ring, ring.name, "BumperReadings"));
  for (const Camera& camera : model.cameras)
    robot.sensors().push_back(named<idl::Sensor>(camera, camera.name, "Image"));
  if (model.odometer) robot.sensors().push_back(named<idl::Sensor>(*model.odometer, "odometry", "Odometry"));
  if (model.turret)
    robot.sensors().push_back(named<idl::Sensor>(*model.turret, model.turret->joint, "TurretAngle"));
  if (model.gripper)
    robot.sensors().push_back(named<idl::Sensor>(*model.gripper, model.gripper->link, "GripperState"));
}

}  // namespace orca::sim
