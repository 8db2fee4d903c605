// SPDX-License-Identifier: LGPL-3.0-or-later
#include "objects.hpp"

#include <cmath>
#include <numbers>

#include "orca/idl/time.hpp"

namespace orca::sim {
namespace {

constexpr const char* kLibrary = "sim.so";

idl::Frame3D frame(const Pose2& pose, double height) {
  idl::Frame3D frame;
  frame.position().x(pose.x);
  frame.position().y(pose.y);
  frame.position().z(height);
  frame.rotation().yaw(pose.yaw);
  return frame;
}

idl::Drive describe(const Drive& drive) {
  idl::Drive object;
  object.name("drive");
  object.library(kLibrary);
  object.driver("orca.hw.Sim");
  object.type(idl::DIFFERENTIAL);
  object.max_speed(drive.max_speed);
  object.max_steer_speed(drive.max_steer_speed);
  object.steer_gain(drive.steer_gain);
  object.speed_change(drive.max_acceleration);
  object.big_turn_angle(drive.big_turn_angle);
  object.big_turn_speed(drive.big_turn_speed);
  return object;
}

idl::SonarRing describe(const SonarRing& ring) {
  idl::SonarRing object;
  object.name(ring.name);
  object.library(kLibrary);
  object.driver("orca.hw.Sim");
  object.type("SonarRangeReadings");
  object.update_interval(to_seconds(ring.period));
  object.number(static_cast<std::uint32_t>(ring.count));
  object.dphi(ring.pitch);
  object.angle_sonar0(ring.first_angle);
  object.radius(ring.radius);
  object.half_lobe(ring.half_lobe);
  object.scale_factor(ring.quantum);
  object.min_range(ring.min_range);
  object.max_range(ring.max_range);
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

void fill(idl::SonarRangeReadings& object, const SonarScan& scan, const SonarRing& ring) {
  object.ranges().clear();
  object.poses().clear();
  object.stamps().clear();
  for (const SonarReading& reading : scan.readings) {
    object.ranges().push_back(reading.range);
    object.poses().push_back(frame(reading.sensor, ring.height));
    object.stamps().push_back(to_time_value(reading.stamp));
  }
  object.min_range(ring.min_range);
  object.max_range(ring.max_range);
  object.half_lobe(ring.half_lobe);
  object.pose(frame(ring.center, ring.height));
}

void fill(idl::Odometry& object, const OdometryReading& reading) {
  object.x(reading.pose.x);
  object.y(reading.pose.y);
  object.steer_angle(reading.pose.yaw);
  object.translational_velocity(reading.velocity.forward);
  object.steering_velocity(reading.velocity.turn);
  object.stamp(to_time_value(reading.stamp));
}

void fill(idl::RobotPose& object, const SharedWorld::Inbox::Truth& truth) {
  object.x(truth.pose.x);
  object.y(truth.pose.y);
  object.orientation(truth.pose.yaw);
  object.translational_velocity(truth.velocity.forward);
  object.steering_velocity(truth.velocity.turn);
  object.stamp(to_time_value(truth.stamp));
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
  for (const SonarRing& ring : model.sonars) robot.sonar_rings().push_back(describe(ring));
  return robot;
}

void draw(const Scene& from, const std::string& robot, double radius, orca::Scene& to) {
  if (to.walls.empty()) {
    for (const Segment& edge : from.edges) to.walls.push_back({point(edge.a), point(edge.b)});
    for (const Circle& circle : from.circles) draw_circle(circle, to);
  }
  for (const SceneRobot& body : from.robots) {
    if (body.name != robot) continue;
    orca::Scene::Robot drawn{body.name, point(body.pose.position()), body.pose.yaw, radius, {}};
    for (const SceneRobot::Sample& sample : body.trajectory)
      drawn.track.push_back(point(sample.pose.position()));
    to.robots.push_back(std::move(drawn));
  }
}

}  // namespace orca::sim
