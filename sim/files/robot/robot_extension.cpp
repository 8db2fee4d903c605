// SPDX-License-Identifier: LGPL-3.0-or-later
#include "robot_extension.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "extension_readers.hpp"
#include "orca/sim/world.hpp"
#include "robot_rules.hpp"

namespace orca::sim::detail {
namespace {

struct PartKind {
  const xml::ElementRule* rule;
  bool once;  // A robot has at most one.
  void (*read)(const xml::Attributes& e, RobotModel& model);
};

constexpr std::array kPartKinds{
    PartKind{&kDriveRule, true, read_drive},
    PartKind{&kTurretRule, true, read_turret},
    PartKind{&kGripperRule, true, read_gripper},
    PartKind{&kSonarRingRule, false, read_sonar_ring},
    PartKind{&kLaserRule, false, read_laser},
    PartKind{&kInfraredRingRule, false, read_infrared_ring},
    PartKind{&kBumperRingRule, false, read_bumper_ring},
    PartKind{&kOdometryRule, true, read_odometry},
};

void read_robot_attributes(const xml::Attributes& e, RobotModel& model) {
  model.vendor = e.text("vendor").value_or("");
  model.model = e.text("model").value_or("");
  set(model.radius, e.number("radius"));
  set(model.bumper_radius, e.number_or("bumper_radius", model.radius));
  if (model.bumper_radius < model.radius)
    e.error_at("bumper_radius", robot_codes::kContradiction,
               "bumper_radius must not be less than radius: the bumper is outside");
}

// Sensors without a robot need no drive.
void check_fixed(const xml::Attributes& orca, const std::set<const xml::ElementRule*>& parts) {
  for (const xml::ElementRule* const rule : {&kOdometryRule, &kTurretRule, &kGripperRule})
    if (parts.contains(rule))
      orca.error(robot_codes::kMissing,
                 "<orca> needs the element <drive>, because it has <" + std::string(rule->name) + ">");
  if (parts.empty())
    orca.error(robot_codes::kMissing,
               "<orca> needs the element <drive>, or at least a sensor that is to stay in one place");
}

}  // namespace

void check_period(const xml::Attributes& e, Duration period) {
  if (period < World::kTick || period > std::chrono::hours{1})
    e.error_at("period", robot_codes::kContradiction,
               "the period must be between the simulation's tick of 10 ms and an hour");
}

void read_extension(const xml::Element& orca, RobotModel& model, xml::Reporter& reporter) {
  const xml::Attributes e(orca, kOrcaRule, kRobotFile, reporter);
  read_robot_attributes(e, model);
  std::set<const xml::ElementRule*> seen;
  for (const auto& [child, rule] : e.children()) {
    const auto kind = std::ranges::find(kPartKinds, rule, &PartKind::rule);
    const bool again = !seen.insert(rule).second;
    if (again && kind->once) {
      reporter.error(robot_codes::kDuplicate, child->position(),
                     "there is a <" + std::string(rule->name) + "> already; a robot has one");
    } else {
      kind->read({*child, *rule, kRobotFile, reporter}, model);
    }
  }
  if (!seen.contains(&kDriveRule)) check_fixed(e, seen);
  model.fixed = !seen.contains(&kDriveRule);
}

}  // namespace orca::sim::detail
