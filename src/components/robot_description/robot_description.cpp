// SPDX-License-Identifier: LGPL-3.0-or-later
#include <string>

#include "orca/component.hpp"
#include "orca/hw/description.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/system.hpp"
#include "orca/robot_file/figures.hpp"

namespace {

using namespace orca;

idl::DriveType type_of(robot_file::DriveKind kind) {
  switch (kind) {
    case robot_file::DriveKind::synchro: return idl::SYNCHRO;
    case robot_file::DriveKind::holonomic: return idl::HOLONOMIC;
    default: return idl::DIFFERENTIAL;
  }
}

idl::Drive describe(const robot_file::Drive& drive) {
  idl::Drive described;
  described.name("drive");
  described.vendor(drive.label.vendor);
  described.model(drive.label.model);
  described.type(type_of(drive.kind));
  described.max_speed(drive.max_speed);
  described.max_steer_speed(drive.max_turn_rate);
  described.steer_gain(drive.steer_gain);
  described.speed_change(drive.max_acceleration);
  described.big_turn_angle(drive.big_turn_angle);
  described.big_turn_speed(drive.big_turn_speed);
  return described;
}

/// Describes a robot whose base is elsewhere, by the robot's file: what a RobotBaseServer answers of a base of its own.
class RobotDescription final : public Component {
 public:
  explicit RobotDescription(ComponentHost& host) : Component(host) {}

 private:
  Status configure() override {
    if (file_->empty()) return file_.refuse("it describes nothing without the robot's file");
    xml::Diagnostics wrong;
    const std::optional<robot_file::Figures> figures = robot_file::read_figures(*file_, wrong);
    if (!figures) return file_.refuse(wrong.text());
    robot_ = idl::Robot();
    robot_.name(*name_);
    robot_.vendor(figures->drive.label.vendor);
    robot_.model(figures->drive.label.model);
    robot_.radius(figures->radius);
    robot_.bumper_radius(figures->bumper_radius);
    if (figures->size) {
      robot_.length(figures->size->x);
      robot_.width(figures->size->y);
    }
    robot_.drives({describe(figures->drive)});
    return ok();
  }

  Outcome work() override { return again(); }  // it only answers

  Result<Loan<idl::Robot>> on_describe(const ObjectPtr<idl::Ask>& ask) {
    return hw::part_of(robot_, ask->about());
  }

  Param<std::string> file_{
      *this,
      "robot",
      "",
      {.file = true, .fixed = true, .text = "The robot's file (URDF with orca element)."}};
  Param<std::string> name_{*this, "name", "robot", {.fixed = true, .text = "Name of the robot."}};
  QueryServer<idl::Ask, idl::Robot> description_{
      *this,
      "RobotQuery",
      &RobotDescription::on_describe,
      {.text = "Description of the robot: its body and its drive."}};

  idl::Robot robot_;
};

}  // namespace

ORCA_COMPONENT(RobotDescription, "orca.RobotDescription")
