// SPDX-License-Identifier: LGPL-3.0-or-later
#include "robot_sensors.hpp"

#include "orca/sim/sections.hpp"

namespace orca::sim::detail {

RobotSensors::RobotSensors(const RobotModel& robot, const std::string& name, const ErrorLevels& errors,
                           std::uint64_t seed, TimePoint start)
    : model(robot) {
  const auto stream = [&](const std::string& device) { return RandomStream(seed, name, device); };
  for (const SonarRing& s : model.sonars) sonars.emplace_back(s, errors, stream(s.name), start);
  for (const LaserScanner& s : model.lasers)
    lasers.emplace_back(s, sections_of(model, s.sees, s.height), errors, stream(s.name), start);
  for (const InfraredRing& s : model.infrareds) infrareds.emplace_back(s, errors, stream(s.name), start);
  for (const BumperRing& s : model.bumpers) bumpers.emplace_back(s, start);
  for (const Camera& s : model.cameras) cameras.emplace_back(s, start);
}

void RobotSensors::fire(const Caster& caster, std::size_t own_body, const Carriers& carriers) {
  for (std::size_t k = 0; k < sonars.size(); ++k)
    sonars[k].fire(caster, own_body, carriers.of(model.sonars[k].on_turret));
}

void RobotSensors::send(SonarAir& air) {
  for (SonarModel& s : sonars) s.send(air);
}

void RobotSensors::sense(const Caster& caster, const SonarAir& air, std::size_t own_body,
                         const Carriers& carriers) {
  for (SonarModel& s : sonars) s.listen(caster, air);
  for (std::size_t k = 0; k < lasers.size(); ++k)
    lasers[k].run(caster, own_body, carriers.of(model.lasers[k].on_turret));
  for (std::size_t k = 0; k < infrareds.size(); ++k)
    infrareds[k].run(caster, own_body, carriers.of(model.infrareds[k].on_turret));
  for (std::size_t k = 0; k < cameras.size(); ++k)
    cameras[k].run(caster, own_body, carriers.of(model.cameras[k].on_turret));
}

void RobotSensors::feel(std::span<const Touch> touches, const TickSpan& span) {
  for (BumperModel& s : bumpers) s.run(touches, span.to, span.in_robot(span.to));
}

}  // namespace orca::sim::detail
