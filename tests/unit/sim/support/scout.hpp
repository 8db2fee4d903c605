// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "angles.hpp"
#include "orca/sim/robot_model.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim::test {

/// A robot like the Nomad Scout, made here so that tests of the simulation depend on no file.
inline RobotModel scout() {
  RobotModel m;
  m.name = "scout";
  m.radius = 0.19;
  m.bumper_radius = 0.205;
  m.mass = 23.0;
  m.yaw_inertia = 0.45;
  m.parts = {{Part::Cylinder{0.205, 0.3}, {.x = 0.0, .y = 0.0, .z = 0.2}}};
  m.footprint = footprint_of(m.parts);
  m.bottom = height_range_of(m.parts).first;
  m.top = height_range_of(m.parts).second;
  m.drive = {.max_speed = 1.0,
             .max_turn_rate = 2.0,
             .max_acceleration = 0.76,
             .max_turn_acceleration = 4.0,
             .track = 0.3452,
             .wheel_diameter = 0.15,
             .lag = std::chrono::milliseconds{100},
             .dead_time = std::chrono::milliseconds{50}};
  SonarRing ring;
  ring.name = "sonar";
  ring.count = 16;
  ring.pitch = 22.5 * kDegree;
  ring.half_lobe = 12.5 * kDegree;
  ring.min_range = 0.15;
  ring.max_range = 6.5;
  ring.quantum = 0.0254;
  ring.radius = 0.19;
  ring.period = std::chrono::milliseconds{200};
  ring.height = 0.3;
  for (std::size_t k = 0; k < ring.count; ++k) ring.order.push_back(k);
  m.sonars = {ring};
  m.odometer = Odometer{std::chrono::milliseconds{50}};
  return m;
}

/// A room, 10 x 10 m inside around the origin, with a post of 0.3 m radius at (3, 0).
inline WorldModel test_room() {
  const double h = 2.5;
  return {"test room",
          {{"east", Box{{5.1, 0, 0}, {0.1, 5.2}}, h},
           {"west", Box{{-5.1, 0, 0}, {0.1, 5.2}}, h},
           {"north", Box{{0, 5.1, 0}, {5.2, 0.1}}, h},
           {"south", Box{{0, -5.1, 0}, {5.2, 0.1}}, h},
           {"post", Circle{{3, 0}, 0.3}, h}},
          {}};
}

}  // namespace orca::sim::test
