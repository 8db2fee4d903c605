// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mounts.hpp"

#include <algorithm>
#include <cmath>

#include "footprint.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/base/text.hpp"
#include "orca/sim/sections.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/number.hpp"
#include "urdf_check.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kUpright = 1.0 - 1e-9;

void mount_turret(Turret& turret, const UrdfBody& body, const xml::Attributes& e) {
  const auto found = body.joints.find(turret.joint);
  if (found == body.joints.end()) return;
  const UrdfJoint& joint = found->second;
  if (!joint.continuous || joint.upright < kUpright)
    return e.error_at("joint", robot_codes::kContradiction,
                      "a turret needs a joint of type continuous whose axis points up: it turns without end");
  turret.axis = {joint.X_BJ.x, joint.X_BJ.y};
  for (std::size_t i = joint.first_part; i < joint.end_part; ++i)
    if (round_radius(body.parts[i], turret.axis) < 0.0)
      return e.error_at("joint", robot_codes::kContradiction,
                        "the collision geometry of a turret must be round about its axis, upright cylinders "
                        "and spheres on it: the simulator does not turn it");
}

// Returns the part of the z axis that points up: 1 of what is level, -1 of what hangs upside down.
double upright(const Pose3& X) { return 1.0 - 2.0 * (X.qx * X.qx + X.qy * X.qy); }

// Reports a link that looks up or down, or is upside down and no laser's.
void check_upright(const UrdfBody& body, const xml::Attributes& e, bool is_laser) {
  const xml::Attribute* a = e.attribute("link");
  const auto link = a != nullptr ? body.links.find(a->value) : body.links.end();
  if (link == body.links.end()) return;
  const double up = upright(link->second);
  if (up < kUpright && !(is_laser && up <= -kUpright))
    e.error_at("link", robot_codes::kContradiction,
               "the link " + in_quotes(a->value) +
                   " is tilted: sensors and grippers of the simulator look horizontally, their z axis points "
                   "up; a laser may hang upside down, its z axis pointing down");
}

Pose2 flat(const Pose3& X) {
  const double yaw =
      portable::atan2(2.0 * (X.qw * X.qz + X.qx * X.qy), 1.0 - 2.0 * (X.qy * X.qy + X.qz * X.qz));
  return {X.x, X.y, yaw};
}

// Returns whether the link turns with the turret. @param turret  its joint, or null.
bool is_on(const UrdfJoint* turret, const std::string& link) {
  return turret != nullptr && std::ranges::find(turret->links, link) != turret->links.end();
}

// @tparam Sensor  has link, center, height and on_turret.
template <class Sensor>
void mount(std::vector<Sensor>& sensors, const UrdfBody& body, const UrdfJoint* turret) {
  for (Sensor& sensor : sensors) {
    const auto link = body.links.find(sensor.link);
    if (link == body.links.end()) continue;
    sensor.center = flat(link->second);
    sensor.height = link->second.z;
    sensor.on_turret = is_on(turret, sensor.link);
  }
}

void mount(std::vector<Camera>& cameras, const UrdfBody& body, const UrdfJoint* turret) {
  for (Camera& camera : cameras) {
    const auto link = body.links.find(camera.link);
    if (link == body.links.end()) continue;
    camera.center = flat(link->second);
    camera.link_height = link->second.z;
    camera.on_turret = is_on(turret, camera.link);
  }
}

// A laser that hangs upside down measures in the other sense.
void turn_over(std::vector<LaserScanner>& lasers, const UrdfBody& body) {
  for (LaserScanner& laser : lasers) {
    const auto link = body.links.find(laser.link);
    if (link == body.links.end() || upright(link->second) > 0.0) continue;
    laser.upside_down = true;
    laser.first_angle = -laser.first_angle;
    laser.pitch = -laser.pitch;
    for (LaserScanner::Sector& sector : laser.ignore) sector = {-sector.to, -sector.from};
  }
}

// Reports links that a laser is to see and cannot: there are none of the name, nothing solid is at the laser's height, or they turn
// where it does not.
void check_sight(const RobotModel& model, const UrdfBody& body, const UrdfJoint* turret,
                 const xml::Attributes& e) {
  const xml::Attribute* const name = e.attribute("name");
  const auto laser = name == nullptr ? model.lasers.end()
                                     : std::ranges::find(model.lasers, name->value, &LaserScanner::name);
  if (laser == model.lasers.end()) return;
  for (const std::string& link : laser->sees) {
    if (!body.links.contains(link)) {
      e.error_at("sees", robot_codes::kUnknownName, "there is no link " + in_quotes(link));
    } else if (is_on(turret, link) != laser->on_turret) {
      e.error_at("sees", robot_codes::kContradiction,
                 "the link " + in_quotes(link) +
                     " and the laser must both turn with the turret, or both stay with the body");
    } else if (sections_of(model, {link}, laser->height).empty()) {
      e.error_at("sees", robot_codes::kContradiction,
                 "the link " + in_quotes(link) + " has no <collision> at the height of the laser, " +
                     xml::number_text(laser->height) + " m above the floor");
    }
  }
}

// Gives the gripper its place. Reports one whose root is inside the body, where what it holds could not be put down.
void mount_gripper(RobotModel& model, const UrdfBody& body, const UrdfJoint* turret,
                   const xml::Attributes& e) {
  constexpr double kOut = 0.001;  // [m] Ahead of a root on the edge of the body is clearly outside.
  Gripper& gripper = *model.gripper;
  const auto link = body.links.find(gripper.link);
  if (link == body.links.end()) return;
  gripper.mount = flat(link->second);
  gripper.height = link->second.z;
  if (is_on(turret, gripper.link))
    return e.error_at(
        "link", robot_codes::kContradiction,
        "a gripper sits on the body; the link " + in_quotes(gripper.link) + " turns with the turret");
  if (!model.parts.empty() && contains(model.footprint, gripper.mount * Vec2{kOut, 0.0}))
    e.error_at(
        "link", robot_codes::kContradiction,
        "the link " + in_quotes(gripper.link) +
            " lies inside the body, seen from above; the paddles begin at its edge and point away from it");
}

}  // namespace

void mount_devices(RobotModel& model, const UrdfBody& body, const xml::Element& orca,
                   xml::Reporter& reporter) {
  const xml::Element* turret = only_child(orca, "turret");
  if (turret != nullptr && model.turret) mount_turret(*model.turret, body, {*turret, kRobotFile, reporter});
  for (const xml::Element& e : orca.children())
    check_upright(body, {e, kRobotFile, reporter}, e.name() == "laser");
  const auto joint = model.turret ? body.joints.find(model.turret->joint) : body.joints.end();
  const UrdfJoint* turns = joint != body.joints.end() ? &joint->second : nullptr;
  mount(model.sonars, body, turns);
  mount(model.lasers, body, turns);
  turn_over(model.lasers, body);
  for (const xml::Element& e : orca.children())
    if (e.name() == "laser") check_sight(model, body, turns, {e, kRobotFile, reporter});
  mount(model.infrareds, body, turns);
  mount(model.cameras, body, turns);
  const xml::Element* gripper = only_child(orca, "gripper");
  if (gripper != nullptr && model.gripper)
    mount_gripper(model, body, turns, {*gripper, kRobotFile, reporter});
}

}  // namespace orca::sim::detail
