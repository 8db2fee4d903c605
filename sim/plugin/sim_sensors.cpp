// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sim_sensors.hpp"

#include <utility>

#include "objects.hpp"
#include "orca/geometry/objects/ranges.hpp"

namespace orca::sim {
namespace {

// Only where there are several of a kind do ports need their names.
template <class Devices, class Models>
void make(Devices& devices, const Models& models) {
  for (const auto& model : models)
    devices.push_back(std::make_unique<typename Devices::value_type::element_type>(
        model, models.size() > 1 ? model.name : ""));
}

template <class Devices>
void list(const Devices& devices, std::vector<hw::SensorEndpoint*>& endpoints) {
  for (const auto& device : devices) endpoints.push_back(&device->endpoint);
}

template <class T, class... Readings>
void publish_one(hw::SensorHW<T>& sensor, const Readings&... readings) {
  Loan<T> object = sensor.loan();
  fill(*object, readings...);
  sensor.publish(std::move(object));
}

template <class Devices, class Readings>
void publish_all(const Devices& devices, const Readings& readings) {
  for (const auto& [number, reading] : readings)
    publish_one(devices[number]->endpoint, reading, devices[number]->model);
}

// Publishes ranges with what the robot's file guesses of their errors.
template <class Devices, class Readings>
void publish_ranges(const Devices& devices, const Readings& readings, Realism realism) {
  for (const auto& [number, reading] : readings) {
    auto& device = *devices[number];
    auto object = device.endpoint.loan();
    fill(*object, reading, device.model);
    set_uncertainty(*object, device.model.errors.at(realism));
    device.endpoint.publish(std::move(object));
  }
}

}  // namespace

SimSensors::SimSensors(const RobotModel& robot, Realism realism) : realism_(realism) {
  make(sonars_, robot.sonars);
  make(lasers_, robot.lasers);
  make(infrareds_, robot.infrareds);
  make(bumpers_, robot.bumpers);
  make(cameras_, robot.cameras);
  if (robot.turret) turret_ = std::make_unique<hw::SensorHW<idl::TurretAngle>>(robot.turret->period);
  if (robot.gripper) gripper_ = std::make_unique<hw::SensorHW<idl::GripperState>>(robot.gripper->period);
  if (robot.battery) battery_ = std::make_unique<hw::SensorHW<idl::Battery>>(robot.battery->period);
  if (!robot.odometer) return;
  odometry_ = std::make_unique<hw::SensorHW<idl::Odometry>>(robot.odometer->period);
  uncertainty_.emplace(type_of(robot.drive.kind), robot.drive.track, robot.odometer->errors.at(realism));
}

std::vector<hw::SensorEndpoint*> SimSensors::endpoints() {
  std::vector<hw::SensorEndpoint*> all;
  list(sonars_, all);
  list(lasers_, all);
  list(infrareds_, all);
  list(bumpers_, all);
  list(cameras_, all);
  if (odometry_) all.push_back(odometry_.get());
  if (turret_) all.push_back(turret_.get());
  if (gripper_) all.push_back(gripper_.get());
  if (battery_) all.push_back(battery_.get());
  all.push_back(&truth_);
  return all;
}

void SimSensors::publish(const SharedWorld::Inbox& inbox) {
  publish_ranges(sonars_, inbox.sonar, realism_);
  publish_ranges(lasers_, inbox.laser, realism_);
  publish_ranges(infrareds_, inbox.infrared, realism_);
  publish_all(bumpers_, inbox.bumper);
  publish_all(cameras_, inbox.camera);
  for (const OdometryReading& reading : inbox.odometry) {
    uncertainty_->move_to(reading.pose);
    publish_one(*odometry_, reading, uncertainty_->covariance());
  }
  for (const TurretReading& reading : inbox.turret) publish_one(*turret_, reading);
  for (const GripperReading& reading : inbox.gripper) publish_one(*gripper_, reading);
  for (const BatteryReading& reading : inbox.battery) publish_one(*battery_, reading);
  for (const auto& truth : inbox.truth) publish_one(truth_, truth);
}

void SimSensors::skip(const SharedWorld::Inbox& inbox) {
  for (const OdometryReading& reading : inbox.odometry) uncertainty_->move_to(reading.pose);
}

}  // namespace orca::sim
