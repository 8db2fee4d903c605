// SPDX-License-Identifier: LGPL-3.0-or-later
#include "objects.hpp"

#include <numbers>

namespace orca::sim {
namespace {

constexpr const char* kLibrary = "sim.so";

idl::DriveType type_of(DriveKind kind) {
  switch (kind) {
    case DriveKind::differential: return idl::DIFFERENTIAL;
    case DriveKind::synchro: return idl::SYNCHRO;
    case DriveKind::holonomic: return idl::HOLONOMIC;
  }
  return idl::DIFFERENTIAL;
}

idl::Actuator describe(const Turret& turret) {
  idl::Actuator object;
  object.name(turret.joint);
  object.library(kLibrary);
  object.driver("orca.hw.Sim");
  return object;
}

idl::Drive describe(const Drive& drive) {
  idl::Drive object;
  object.name("drive");
  object.library(kLibrary);
  object.driver("orca.hw.Sim");
  object.type(type_of(drive.kind));
  object.max_speed(drive.max_speed);
  object.max_steer_speed(drive.max_steer_speed);
  object.steer_gain(drive.steer_gain);
  object.speed_change(drive.max_acceleration);
  object.big_turn_angle(drive.big_turn_angle);
  object.big_turn_speed(drive.big_turn_speed);
  return object;
}

orca::Scene::Point point(Vec2 p) { return {p.x, p.y}; }

void draw_circle(const Circle& circle, orca::Scene& to) {
  constexpr int kSides = 32;
  for (int i = 0; i < kSides; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSides;
    const double b = 2.0 * std::numbers::pi * (i + 1) / kSides;
    to.walls.push_back({point(circle.center + circle.radius * direction(a)),
                        point(circle.center + circle.radius * direction(b))});
  }
}

}  // namespace

hw::DriveLimits limits_of(const RobotModel& robot) {
  const Drive& drive = robot.drive;
  return {.max_speed = drive.max_speed,
          .max_steer_speed = drive.max_steer_speed,
          .steer_gain = drive.steer_gain,
          .big_turn_angle = drive.big_turn_angle,
          .big_turn_speed = drive.big_turn_speed,
          .type = type_of(drive.kind),
          .turret = robot.turret.has_value()};
}

idl::Robot describe(const RobotModel& model, const std::string& name) {
  idl::Robot robot;
  robot.name(name);
  robot.vendor(model.vendor);
  robot.model(model.model);
  robot.library(kLibrary);
  robot.radius(model.radius);
  robot.bumper_radius(model.bumper_radius);
  robot.drives({describe(model.drive)});
  if (model.turret) robot.actuators({describe(*model.turret)});
  describe_sensors(model, robot);
  return robot;
}

void draw(const Scene& from, const std::string& name, const RobotModel& model,
          std::vector<orca::Scene::Moment> moments, orca::Scene& to) {
  if (to.walls.empty()) {
    for (const Segment& edge : from.edges) to.walls.push_back({point(edge.a), point(edge.b)});
    for (const Circle& circle : from.circles) draw_circle(circle, to);
  }
  for (const SceneRobot& body : from.robots) {
    if (body.name != name) continue;
    orca::Scene::Robot drawn{body.name, point(body.pose.position()), body.pose.yaw, model.radius, {},
                             {},        std::move(moments)};
    for (const Segment& edge : edges_of(model.footprint))
      drawn.outline.push_back({point(edge.a), point(edge.b)});
    for (const SceneRobot::Sample& sample : body.trajectory)
      drawn.track.push_back(point(sample.pose.position()));
    to.robots.push_back(std::move(drawn));
  }
}

}  // namespace orca::sim
