// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mounts.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/portable_math.hpp"
#include "orca/base/text.hpp"
#include "orca/robots/codes.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/names.hpp"
#include "robot_rules.hpp"
#include "urdf_parts.hpp"

namespace orca::robots::detail {
namespace {

constexpr double kUpright = 1.0 - 1e-9;

std::vector<std::string> names_of(const xml::Element& robot, std::string_view kind) {
  std::vector<std::string> names;
  for (const xml::Element& e : robot.children())
    if (const xml::Attribute* name = e.attribute("name"); name != nullptr && e.name() == kind)
      names.push_back(name->value);
  return names;
}

// Reports an attribute that names none of the things.
void check_name(const std::vector<std::string>& names, const xml::Attributes& e, const char* attribute) {
  const xml::Attribute* a = e.readable(attribute);
  if (a == nullptr || std::ranges::find(names, a->value) != names.end()) return;
  e.error_at(attribute, codes::kUnknownName,
             std::string("there is no ") + attribute + " " + in_quotes(a->value) +
                 xml::did_you_mean(xml::nearest_name(a->value, names)));
}

// @pre  the robot has a turret.
void mount_turret(Characteristics& robot, const UrdfBody& body, BodyReader* body_reader,
                  const xml::Attributes& e) {
  Turret& turret = *robot.turret;
  const auto found = body.joints.find(turret.joint);
  if (found == body.joints.end()) return;
  const UrdfJoint& joint = found->second;
  if (!joint.continuous || joint.upright < kUpright)
    return e.error_at("joint", codes::kContradiction,
                      "a turret needs a joint of type continuous whose axis points up: it turns without end");
  turret.axis = {joint.X_BJ.x, joint.X_BJ.y};
  turret.first_part = joint.first_part;
  turret.end_part = joint.end_part;
  if (body_reader != nullptr) body_reader->check_turret(robot, e);
}

// Reports a link that looks up, down or upside down.
void check_upright(const UrdfBody& body, const xml::Attributes& e) {
  const xml::Attribute* a = e.attribute("link");
  const auto link = a != nullptr ? body.links.find(a->value) : body.links.end();
  if (link == body.links.end()) return;
  const Pose3& X = link->second;
  if (1.0 - 2.0 * (X.qx * X.qx + X.qy * X.qy) < kUpright)
    e.error_at("link", codes::kContradiction,
               "the link " + in_quotes(a->value) +
                   " is tilted: sensors of the simulator look horizontally, their z axis points up");
}

// @tparam Sensor  has link, center, height and on_turret.
template <class Sensor>
void mount(std::vector<Sensor>& sensors, const UrdfBody& body, const UrdfJoint* turret) {
  for (Sensor& sensor : sensors) {
    const auto link = body.links.find(sensor.link);
    if (link == body.links.end()) continue;
    const Pose3& X = link->second;
    const double yaw =
        portable::atan2(2.0 * (X.qw * X.qz + X.qx * X.qy), 1.0 - 2.0 * (X.qy * X.qy + X.qz * X.qz));
    sensor.center = {X.x, X.y, yaw};
    sensor.height = X.z;
    sensor.on_turret =
        turret != nullptr && std::ranges::find(turret->links, sensor.link) != turret->links.end();
  }
}

}  // namespace

void check_mounts(const xml::Element& robot, const xml::Element& orca, xml::Reporter& reporter) {
  if (const xml::Element* turret = only_child(orca, "turret"))
    check_name(names_of(robot, "joint"), {*turret, kRobotFile, reporter}, "joint");
  const std::vector<std::string> links = names_of(robot, "link");
  for (const xml::Element& e : orca.children()) check_name(links, {e, kRobotFile, reporter}, "link");
}

void mount_devices(Characteristics& robot, const UrdfBody& body, const xml::Element& orca,
                   BodyReader* body_reader, xml::Reporter& reporter) {
  const xml::Element* turret = only_child(orca, "turret");
  if (turret != nullptr && robot.turret)
    mount_turret(robot, body, body_reader, {*turret, kRobotFile, reporter});
  for (const xml::Element& e : orca.children()) check_upright(body, {e, kRobotFile, reporter});
  const auto joint = robot.turret ? body.joints.find(robot.turret->joint) : body.joints.end();
  const UrdfJoint* turns = joint != body.joints.end() ? &joint->second : nullptr;
  mount(robot.sonars, body, turns);
  mount(robot.lasers, body, turns);
  mount(robot.infrareds, body, turns);
}

}  // namespace orca::robots::detail
