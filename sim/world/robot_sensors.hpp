// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sensors/bumper_model.hpp"
#include "sensors/camera_model.hpp"
#include "sensors/infrared_model.hpp"
#include "sensors/laser_model.hpp"
#include "sensors/sonar_model.hpp"

namespace orca::sim::detail {

// The last tick, for sensors on a robot's body and for those on its turret.
struct Carriers {
  TickSpan body, turret;
  [[nodiscard]] const TickSpan& of(bool on_turret) const { return on_turret ? turret : body; }
};

// The sensors of a robot, kind by kind in the order of its file. The model must outlive them.
struct RobotSensors {
  // @param seed  of the run; the noise is keyed by it, the robot's name and the device's.
  RobotSensors(const RobotModel& robot, const std::string& name, const ErrorLevels& errors,
               std::uint64_t seed, TimePoint start);

  // Lets the sonars fire.
  void fire(const Caster& caster, std::size_t own_body, const Carriers& carriers);
  // Puts the chirps that the sonars have fired into the air.
  void send(SonarAir& air);
  // Lets all but the bumpers measure. @pre  send() was called for all robots.
  void sense(const Caster& caster, const SonarAir& air, std::size_t own_body, const Carriers& carriers);
  // Lets the bumpers feel what touches the robot now.
  void feel(std::span<const Touch> touches, const TickSpan& span);

  const RobotModel& model;
  std::vector<SonarModel> sonars{};
  std::vector<LaserModel> lasers{};
  std::vector<InfraredModel> infrareds{};
  std::vector<BumperModel> bumpers{};
  std::vector<CameraModel> cameras{};
};

}  // namespace orca::sim::detail
