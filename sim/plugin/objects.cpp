// SPDX-License-Identifier: LGPL-3.0-or-later
#include "objects.hpp"

#include <numbers>

namespace orca::sim {
namespace {

constexpr const char* kLibrary = "sim.so";

idl::Actuator describe(const Turret& turret) {
  idl::Actuator object;
  object.name(turret.joint);
  label(object, turret.label);
  return object;
}

idl::Actuator describe(const Gripper& gripper) {
  idl::Actuator object;
  object.name(gripper.link);
  label(object, gripper.label);
  return object;
}

idl::Drive describe(const Drive& drive) {
  idl::Drive object;
  object.name("drive");
  label(object, drive.label);
  object.type(type_of(drive.kind));
  object.max_speed(drive.max_speed);
  object.max_steer_speed(drive.max_turn_rate);
  object.steer_gain(drive.steer_gain);
  object.speed_change(drive.max_acceleration);
  object.big_turn_angle(drive.big_turn_angle);
  object.big_turn_speed(drive.big_turn_speed);
  return object;
}

void draw_circle(const Circle& circle, Scene& to) {
  constexpr int kSides = 32;
  for (int i = 0; i < kSides; ++i) {
    const double a = 2.0 * std::numbers::pi * i / kSides;
    const double b = 2.0 * std::numbers::pi * (i + 1) / kSides;
    to.walls.push_back(
        {circle.center + circle.radius * direction(a), circle.center + circle.radius * direction(b)});
  }
}

}  // namespace

idl::DriveType type_of(DriveKind kind) {
  switch (kind) {
    case DriveKind::differential: return idl::DIFFERENTIAL;
    case DriveKind::synchro: return idl::SYNCHRO;
    case DriveKind::holonomic: return idl::HOLONOMIC;
  }
  return idl::DIFFERENTIAL;
}

GripperOrder order_of(const idl::GripperCommand& command) {
  GripperOrder order;
  if (command.paddles() == idl::PADDLES_OPEN) order.paddles = Paddles::open;
  if (command.paddles() == idl::PADDLES_CLOSE) order.paddles = Paddles::close;
  if (command.lift() == idl::LIFT_UP) order.lift = Lift::up;
  if (command.lift() == idl::LIFT_DOWN) order.lift = Lift::down;
  return order;
}

hw::DriveLimits limits_of(const RobotModel& robot) {
  const Drive& drive = robot.drive;
  return {.max_speed = drive.max_speed,
          .max_turn_rate = drive.max_turn_rate,
          .steer_gain = drive.steer_gain,
          .big_turn_angle = drive.big_turn_angle,
          .big_turn_speed = drive.big_turn_speed,
          .type = type_of(drive.kind)};
}

namespace {

// Returns the size of the rectangle around the origin that holds a plan; 0 for a circle.
Vec2 size_of(const Shape& footprint) {
  if (std::holds_alternative<Circle>(footprint)) return {};
  const auto [low, high] = bounds_of(footprint);
  return {2.0 * std::max(-low.x, high.x), 2.0 * std::max(-low.y, high.y)};
}

}  // namespace

idl::Robot describe(const RobotModel& model, const std::string& name) {
  idl::Robot robot;
  robot.name(name);
  robot.vendor(model.vendor);
  robot.model(model.model);
  robot.library(kLibrary);
  robot.radius(model.radius);
  robot.bumper_radius(model.bumper_radius);
  const Vec2 size = size_of(model.footprint);
  robot.length(size.x);
  robot.width(size.y);
  if (!model.fixed) robot.drives({describe(model.drive)});
  if (model.turret) robot.actuators().push_back(describe(*model.turret));
  if (model.gripper) robot.actuators().push_back(describe(*model.gripper));
  describe_sensors(model, robot);
  return robot;
}

void draw(const Snapshot& from, const std::string& name, const RobotModel& model,
          std::vector<Scene::Moment> moments, std::vector<Scene::Step> motion,
          std::vector<Scene::Encounter> encounters, Scene& to) {
  if (to.walls.empty()) {
    for (const Segment& edge : from.edges) to.walls.push_back({edge.a, edge.b});
    for (const Circle& circle : from.circles) draw_circle(circle, to);
    for (const Place& place : from.places) to.places.push_back({place.name, place.pose.position()});
  }
  for (const RobotSnapshot& body : from.robots) {
    if (body.name != name) continue;
    Scene::Robot drawn{body.name, body.pose,          model.radius,      {},
                       {},        std::move(moments), std::move(motion), std::move(encounters)};
    for (const Segment& edge : edges_of(model.footprint)) drawn.outline.push_back({edge.a, edge.b});
    for (const RobotSnapshot::Sample& sample : body.trajectory) drawn.track.push_back(sample.pose.position());
    to.robots.push_back(std::move(drawn));
  }
}

void draw_start(const WorldModel& world, const std::string& name, const RobotModel& model, const Pose2& start,
                Scene& to) {
  if (to.places.empty())
    for (const Place& place : world.places) to.places.push_back({place.name, place.pose.position()});
  Scene::Robot& drawn = to.robots.emplace_back();
  drawn.name = name;
  drawn.pose = start;
  drawn.radius_m = model.radius;
}

}  // namespace orca::sim
