// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/robot_figures.hpp"

#include <array>
#include <map>
#include <sstream>

#include "orca/base/text.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::hw {
namespace {

using xml::Element;

// Where a link is on the one above it.
struct Joint {
  std::string parent;
  Pose2 place;
  double height = 0.0;  // [m]
  bool level = true;
};

// Reads a robot file and notes what is wrong with it. It looks only for what drivers need: the simulator checks the whole.
class FiguresReader {
 public:
  FiguresReader(const Element& robot, std::vector<HardwareFault>& faults) : robot_(robot), faults_(faults) {}

  RobotFigures read() {
    RobotFigures figures;
    const Element* const orca = child(robot_, "orca");
    if (orca == nullptr) {
      complain(robot_,
               "there is no element <orca> with the robot's figures; docs/robot-files.md describes it");
      return figures;
    }
    figures.radius = number(*orca, "radius", "m");
    figures.bumper_radius =
        orca->attribute("bumper_radius") != nullptr ? number(*orca, "bumper_radius", "m") : figures.radius;
    if (const Element* const drive = child(*orca, "drive")) figures.wheels = wheels(*drive);
    if (const Element* const gripper = child(*orca, "gripper")) figures.gripper = text(*gripper, "link");
    read_joints();
    for (const Element& e : orca->children())
      if (e.name() == "laser") figures.lasers.push_back(laser(e));
    return figures;
  }

 private:
  static const Element* child(const Element& parent, std::string_view name) {
    for (const Element& e : parent.children())
      if (e.name() == name) return &e;
    return nullptr;
  }
  static std::string text(const Element& e, std::string_view name) {
    const xml::Attribute* const a = e.attribute(name);
    return a != nullptr ? a->value : "";
  }

  void complain(const Element& at, const std::string& what) {
    faults_.push_back({"robot", at.position().text() + ": " + what});
  }

  double number(const Element& e, const char* name, const char* si) {
    const Result<double> value = xml::parse_quantity(text(e, name), si);
    if (!value) complain(e, "<" + e.name() + "> needs " + name + " in " + si + ": " + value.error().message);
    return value ? *value : 0.0;
  }

  RobotFigures::Wheels wheels(const Element& drive) {
    RobotFigures::Wheels wheels;
    const std::string type = text(drive, "type");
    if (type == "synchro") wheels.type = idl::SYNCHRO;
    if (type == "holonomic") wheels.type = idl::HOLONOMIC;
    wheels.max_speed = number(drive, "max_speed", "m/s");
    wheels.max_turn_rate = number(drive, "max_steer_speed", "rad/s");
    wheels.max_acceleration = number(drive, "max_acceleration", "m/s2");
    wheels.track = number(drive, "track", "m");
    return wheels;
  }

  // Three numbers, or nothing where the attribute is missing.
  std::array<double, 3> three(const Element& e, const char* name) {
    std::array<double, 3> values{};
    std::istringstream words(text(e, name));
    std::string word;
    std::size_t count = 0;
    for (; words >> word; ++count) {
      const Result<double> value = xml::parse_number(word);
      if (!value || count == values.size()) break;
      values[count] = *value;
    }
    if (count != 0 && count != values.size())
      complain(e, std::string(name) + " needs three numbers, as in \"0.1 0 0.3\"");
    return values;
  }

  void read_joints() {
    for (const Element& e : robot_.children()) {
      const Element* const parent = child(e, "parent");
      const Element* const below = child(e, "child");
      if (e.name() != "joint" || parent == nullptr || below == nullptr) continue;
      Joint joint{text(*parent, "link"), {}};
      if (const Element* const origin = child(e, "origin")) {
        const std::array<double, 3> xyz = three(*origin, "xyz");
        const std::array<double, 3> rpy = three(*origin, "rpy");
        joint.place = {xyz[0], xyz[1], rpy[2]};
        joint.height = xyz[2];
        joint.level = rpy[0] == 0.0 && rpy[1] == 0.0;
      }
      joints_[text(*below, "link")] = joint;
    }
  }

  RobotFigures::Laser laser(const Element& e) {
    RobotFigures::Laser laser{text(e, "name"), {}};
    std::string link = text(e, "link");
    bool level = true;
    for (std::size_t steps = 0; joints_.contains(link) && steps <= joints_.size(); ++steps) {
      const Joint& joint = joints_.at(link);
      laser.place = joint.place * laser.place;
      laser.height += joint.height;
      level = level && joint.level;
      link = joint.parent;
    }
    if (!level)
      complain(e, "the laser " + in_quotes(laser.name) +
                      " is tilted; drivers know lasers that look horizontally only");
    return laser;
  }

  const Element& robot_;
  std::vector<HardwareFault>& faults_;
  std::map<std::string, Joint> joints_;  // by the link below
};

}  // namespace

std::optional<RobotFigures> read_robot_figures(const std::string& path, std::vector<HardwareFault>& faults) {
  if (path.empty()) return std::nullopt;
  xml::Diagnostics diagnostics;
  const std::optional<xml::Document> document = xml::read_file(path, diagnostics);
  for (const xml::Diagnostic& wrong : diagnostics.sorted())
    if (wrong.severity == xml::Severity::error)
      faults.push_back({"robot", wrong.position.text() + ": " + wrong.message});
  if (!document || diagnostics.has_errors()) return std::nullopt;
  const std::size_t before = faults.size();
  RobotFigures figures = FiguresReader(document->root, faults).read();
  return faults.size() == before ? std::optional(std::move(figures)) : std::nullopt;
}

}  // namespace orca::hw
