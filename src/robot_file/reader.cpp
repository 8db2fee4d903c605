// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/robot_file/reader.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "orca/base/text.hpp"
#include "orca/geometry/usual_figures.hpp"
#include "orca/robot_file/rules.hpp"
#include "orca/xml/names.hpp"
#include "part_readers.hpp"

namespace orca::robot_file {
namespace {

struct PartKind {
  const xml::ElementRule* rule;
  bool once;  // A robot has at most one.
  void (*read)(const xml::Attributes& e, Devices& model);
};

constexpr std::array kPartKinds{
    PartKind{&kDriveRule, true, read_drive},
    PartKind{&kTurretRule, true, read_turret},
    PartKind{&kGripperRule, true, read_gripper},
    PartKind{&kBatteryRule, true, read_battery},
    PartKind{&kSonarRingRule, false, read_sonar_ring},
    PartKind{&kLaserRule, false, read_laser},
    PartKind{&kInfraredRingRule, false, read_infrared_ring},
    PartKind{&kBumperRingRule, false, read_bumper_ring},
    PartKind{&kCameraRule, false, read_camera},
    PartKind{&kOdometryRule, true, read_odometry},
};

void read_robot_attributes(const xml::Attributes& e, Devices& model) {
  model.vendor = e.text("vendor").value_or("");
  model.model = e.text("model").value_or("");
  set(model.radius, e.number("radius"));
  set(model.bumper_radius, e.number_or("bumper_radius", model.radius));
  if (model.bumper_radius < model.radius)
    e.error_at("bumper_radius", codes::kContradiction,
               "bumper_radius must not be less than radius: the bumper is outside");
}

// Sensors without a robot need no drive.
void check_fixed(const xml::Attributes& orca, const std::set<const xml::ElementRule*>& parts) {
  for (const xml::ElementRule* const rule : {&kOdometryRule, &kTurretRule, &kGripperRule, &kBatteryRule})
    if (parts.contains(rule))
      orca.error(codes::kMissing,
                 "<orca> needs the element <drive>, because it has <" + std::string(rule->name) + ">");
  if (parts.empty())
    orca.error(codes::kMissing,
               "<orca> needs the element <drive>, or at least a sensor that is to stay in one place");
}

template <class Device>
bool holds(const std::vector<Device>& devices, const std::string& name) {
  return std::ranges::find(devices, name, &Device::name) != devices.end();
}

// Returns the kind of the device that has this name; null if none has it.
const char* owner_of(const std::string& name, const Devices& model) {
  if (name == "odometry") return "device";  // Its errors are drawn by that name.
  if (holds(model.sonars, name)) return "sonar ring";
  if (holds(model.lasers, name)) return "laser";
  if (holds(model.infrareds, name)) return "infrared ring";
  if (holds(model.bumpers, name)) return "bumper ring";
  if (holds(model.cameras, name)) return "camera";
  return nullptr;
}

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

void check_mounts(const xml::Element& robot, const xml::Element& orca, xml::Reporter& reporter) {
  if (const xml::Element* turret = only_child(orca, "turret"))
    check_name(names_of(robot, "joint"), {*turret, kRobotFile, reporter}, "joint");
  const std::vector<std::string> links = names_of(robot, "link");
  for (const xml::Element& e : orca.children()) check_name(links, {e, kRobotFile, reporter}, "link");
}

void read_orca(const xml::Element& orca, Devices& model, xml::Reporter& reporter) {
  const xml::Attributes e(orca, kOrcaRule, kRobotFile, reporter);
  read_robot_attributes(e, model);
  std::set<const xml::ElementRule*> seen;
  for (const auto& [child, rule] : e.children()) {
    const auto kind = std::ranges::find(kPartKinds, rule, &PartKind::rule);
    const bool again = !seen.insert(rule).second;
    if (again && kind->once) {
      reporter.error(codes::kDuplicate, child->position(),
                     "there is a <" + std::string(rule->name) + "> already; a robot has one");
    } else {
      kind->read({*child, *rule, kRobotFile, reporter}, model);
    }
  }
  if (!seen.contains(&kDriveRule)) check_fixed(e, seen);
  model.fixed = !seen.contains(&kDriveRule);
}

}  // namespace

void check_period(const xml::Attributes& e, Duration period) {
  if (period < kShortestPeriod || period > std::chrono::hours{1})
    e.error_at("period", codes::kContradiction,
               "the period must be between the simulation's tick of 10 ms and an hour");
}

DeviceLabel read_label(const xml::Attributes& e) {
  return {e.text("vendor").value_or(""), e.text("model").value_or(""), e.text("port").value_or("")};
}

bool name_is_free(const xml::Attributes& e, const std::string& name, const Devices& model) {
  if (name.empty()) return true;  // Reported already.
  const char* const owner = owner_of(name, model);
  if (owner == nullptr) return true;
  e.error_at("name", codes::kDuplicate,
             std::string("there is a ") + owner + " \"" + name + "\" already; choose another name");
  return false;
}

const xml::Element* only_child(const xml::Element& element, std::string_view name) {
  const auto found = std::ranges::find(element.children(), name, &xml::Element::name);
  return found == element.children().end() ? nullptr : &*found;
}

const xml::Element* read_devices(const xml::Element& robot, Devices& model, xml::Reporter& reporter) {
  const xml::Element* const orca = only_child(robot, "orca");
  if (orca == nullptr) {
    reporter.error(codes::kMissing, robot.position(),
                   "<robot> needs the element <orca radius=\"...\"> with its drive and sensors");
    return nullptr;
  }
  for (const xml::Element& e : robot.children())
    if (e.name() == "orca" && &e != orca)
      reporter.error(codes::kDuplicate, e.position(), "there is an <orca> already; a robot has one");
  read_orca(*orca, model, reporter);
  check_mounts(robot, *orca, reporter);
  return orca;
}

std::string usual_figures_text(const xml::Element& orca) {
  const xml::Element* const drive = only_child(orca, "drive");
  const xml::Element* const odometry = only_child(orca, "odometry");
  return orca::usual_figures_text(drive != nullptr && drive->attribute("steer_gain") == nullptr,
                                  odometry != nullptr && only_child(*odometry, "wheel_errors") == nullptr);
}

Pose2 SonarRing::transducer(std::size_t k) const {
  const double angle = angles.empty() ? first_angle + static_cast<double>(k) * pitch : angles[k];
  const Vec2 p = positions.empty() ? radius * direction(angle) : positions[k];
  return center * Pose2{p.x, p.y, angle};
}

}  // namespace orca::robot_file
