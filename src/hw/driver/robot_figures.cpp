// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/robot_figures.hpp"

#include <algorithm>
#include <sstream>

#include "link_tree.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/base/text.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/geometry/usual_figures.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/extras.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"
#include "robot_plan.hpp"

namespace orca::hw {
namespace {

using xml::Element;

constexpr double kLevel = 1e-9;  // what a level laser may be off, as 1 - cos of the tilt
constexpr std::int64_t kMostBumpers = 64;

// Reads a robot file and notes what is wrong with it. It looks only for what drivers need: the simulator checks the whole.
class FiguresReader {
 public:
  FiguresReader(const Element& robot, std::vector<HardwareFault>& faults)
      : robot_(robot),
        faults_(faults),
        tree_(robot, [this](const Element& at, const std::string& what) { complain(at, what); }) {}

  RobotFigures read() {
    RobotFigures figures;
    const Element* const orca = child_of(robot_, "orca");
    if (orca == nullptr) {
      complain(robot_,
               "there is no element <orca> with the robot's figures; docs/robot-files.md describes it");
      return figures;
    }
    check_once(robot_, "orca");
    for (const char* const part : {"drive", "gripper", "odometry"}) check_once(*orca, part);
    figures.radius = positive(*orca, "radius", "m");
    figures.bumper_radius =
        orca->attribute("bumper_radius") != nullptr ? number(*orca, "bumper_radius", "m") : figures.radius;
    if (const Element* const drive = child_of(*orca, "drive")) figures.wheels = wheels(*drive);
    if (const Element* const gripper = child_of(*orca, "gripper"))
      figures.gripper = text_of(*gripper, "link");
    figures.size = plan_size(robot_, tree_);
    for (const Element& e : orca->children()) read_sensor(e, figures);
    figures.says_wheel_errors = figures.wheel_errors.is_known();
    if (!figures.says_wheel_errors) figures.wheel_errors = kUsualWheelErrors;
    return figures;
  }

 private:
  void read_sensor(const Element& e, RobotFigures& figures) {
    if (e.name() == "laser") figures.lasers.push_back(laser(e));
    if (e.name() == "odometry") figures.wheel_errors = wheel_errors(e);
    if (e.name() == "sonar_ring" && !figures.sonar_errors.is_known()) figures.sonar_errors = errors(e);
    if (e.name() == "bumper_ring") add_bumpers(e, figures.bumpers);
  }

  void check_once(const Element& parent, std::string_view name) {
    const Element* const first = child_of(parent, name);
    for (const Element& e : parent.children())
      if (e.name() == name && &e != first)
        complain(e, std::string(name.front() == 'o' ? "there is an <" : "there is a <") + e.name() +
                        "> already; a robot has one");
  }

  void complain(const Element& at, const std::string& what) {
    faults_.push_back({"robot", at.position().text() + ": " + what});
  }

  double any_number(const Element& e, const char* name, const char* si) {
    const Result<double> value = xml::parse_quantity(text_of(e, name), si);
    const std::string unit = *si == '\0' ? "" : std::string(" in ") + si;
    if (!value) complain(e, "<" + e.name() + "> needs " + name + unit + ": " + value.error().message);
    return value ? *value : 0.0;
  }

  // A driver would steer a robot with these: what makes no sense must not get that far.
  double number(const Element& e, const char* name, const char* si) {
    const double value = any_number(e, name, si);
    if (value < 0.0) complain(e, "<" + e.name() + ">: " + name + " must not be negative");
    return value;
  }

  double positive(const Element& e, const char* name, const char* si) {
    const std::size_t before = faults_.size();
    const double value = number(e, name, si);
    if (value == 0.0 && faults_.size() == before)
      complain(e, "<" + e.name() + ">: " + name + " must be more than 0");
    return value;
  }

  std::optional<double> optional(const Element& e, const char* name, const char* si) {
    if (e.attribute(name) == nullptr) return std::nullopt;
    return number(e, name, si);
  }

  RobotFigures::Wheels wheels(const Element& drive) {
    RobotFigures::Wheels wheels;
    const std::string type = text_of(drive, "type");
    if (type == "synchro") wheels.type = idl::SYNCHRO;
    if (type == "holonomic") wheels.type = idl::HOLONOMIC;
    wheels.max_speed = positive(drive, "max_speed", "m/s");
    wheels.max_turn_rate = positive(drive, "max_steer_speed", "rad/s");
    wheels.max_acceleration = positive(drive, "max_acceleration", "m/s2");
    wheels.track = positive(drive, "track", "m");
    if (drive.attribute("steer_gain") != nullptr) wheels.steer_gain = positive(drive, "steer_gain", "");
    wheels.big_turn_angle = optional(drive, "big_turn_angle", "rad");
    wheels.big_turn_speed = optional(drive, "big_turn_speed", "m/s");
    return wheels;
  }

  RobotFigures::Laser laser(const Element& e) {
    RobotFigures::Laser laser{text_of(e, "name"), {}};
    const Eigen::Isometry3d place = tree_.place_of(text_of(e, "link"));
    laser.place = {place.translation().x(), place.translation().y(),
                   portable::atan2(place(1, 0), place(0, 0))};
    laser.height = place.translation().z();
    laser.errors = errors(e);
    laser.upside_down = place(2, 2) < 0.0;
    if (std::abs(place(2, 2)) < 1.0 - kLevel)
      complain(e, "the laser " + in_quotes(laser.name) +
                      " is tilted; drivers know lasers that look horizontally only, upright or upside down");
    return laser;
  }

  // What the general <range_errors> of a sensor says, not those for a level of realism.
  RangeErrorGuess errors(const Element& sensor) {
    for (const Element& e : sensor.children())
      if (e.name() == "range_errors" && e.attribute("realism") == nullptr)
        return {number(e, "fixed", "m"), number(e, "share", "")};
    return {};
  }

  WheelErrorGuess wheel_errors(const Element& odometry) {
    for (const Element& e : odometry.children())
      if (e.name() == "wheel_errors" && e.attribute("realism") == nullptr)
        return {number(e, "wheel_diameter", ""), number(e, "track", ""), number(e, "slip", "m"),
                optional(e, "turn_slip", "m").value_or(0.0)};
    return {};
  }

  // Adds the directions of the middles of a ring's bumpers.
  void add_bumpers(const Element& e, std::vector<double>& all) {
    const Result<std::int64_t> count = xml::parse_integer(text_of(e, "count"));
    if (!count || *count < 1 || *count > kMostBumpers)
      return complain(
          e, "<bumper_ring> needs count, the number of its bumpers, up to " + std::to_string(kMostBumpers));
    std::vector<double> ring;
    if (const std::string list = text_of(e, "angles"); !list.empty()) {
      ring = angles(e, list);
      if (std::ssize(ring) != *count) complain(e, "<bumper_ring> has another count than angles");
    } else {
      const double first = e.attribute("first_angle") != nullptr ? any_number(e, "first_angle", "rad") : 0.0;
      const double pitch = any_number(e, "pitch", "rad");
      for (std::int64_t i = 0; i < *count; ++i)
        ring.push_back(wrapped(first + static_cast<double>(i) * pitch));
    }
    all.insert(all.end(), ring.begin(), ring.end());
  }

  std::vector<double> angles(const Element& e, const std::string& list) {
    Result<std::vector<double>> all = xml::parse_quantities(list, "rad");
    if (!all)
      return complain(e, "<" + e.name() + "> needs angles in rad: " + all.error().message),
             std::vector<double>{};
    for (double& angle : *all) angle = wrapped(angle);
    return std::move(*all);
  }

  const Element& robot_;
  std::vector<HardwareFault>& faults_;
  const LinkTree tree_;
};

}  // namespace

std::optional<RobotFigures> read_robot_figures(const std::string& path, std::vector<HardwareFault>& faults) {
  if (path.empty()) return std::nullopt;
  xml::Diagnostics diagnostics;
  const Result<std::string> bytes = xml::read_bytes(path);
  const std::optional<xml::Document> document =
      bytes ? xml::read_text(xml::without_extras(*bytes), path, diagnostics)
            : xml::read_file(path, diagnostics);
  for (const xml::Diagnostic& wrong : diagnostics.sorted())
    if (wrong.severity == xml::Severity::error)
      faults.push_back({"robot", wrong.position.text() + ": " + wrong.message});
  if (!document || diagnostics.has_errors()) return std::nullopt;
  const std::size_t before = faults.size();
  RobotFigures figures = FiguresReader(document->root, faults).read();
  return faults.size() == before ? std::optional(std::move(figures)) : std::nullopt;
}

}  // namespace orca::hw
