// SPDX-License-Identifier: LGPL-3.0-or-later
#include "machine.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/base/time.hpp"
#include "orca/robot_file/figures.hpp"

namespace orca::gate {
namespace {

using collision::Solid;
using collision::SweptBody;
using robot_file::BodyPart;
using robot_file::Figures;

constexpr double kAnyHeight = 2.0;  // [m] of a body whose parts are not known

std::vector<Solid> solids_of(const std::vector<BodyPart>& parts) {
  std::vector<Solid> solids;
  for (const BodyPart& part : parts) solids.push_back({part.corners, part.radius, part.bottom, part.top});
  return solids;
}

void append(const std::vector<BodyPart>& parts, std::vector<Solid>& solids) {
  for (Solid& solid : solids_of(parts)) solids.push_back(std::move(solid));
}

// The wheels of a synchro base turn, and its body does not: its frame says nothing about how the body stands.
std::vector<Solid> body_of(const Figures& robot) {
  const double radius = std::max(robot.radius, robot.bumper_radius);
  if (robot.parts.empty()) return {{{{0.0, 0.0}}, radius, 0.0, kAnyHeight}};
  std::vector<Solid> solids = solids_of(robot.parts);
  if (robot.drive.kind != robot_file::DriveKind::synchro) return solids;
  for (Solid& solid : solids) solid = {{{0.0, 0.0}}, SweptBody({&solid, 1}).reach(), solid.bottom, solid.top};
  return solids;
}

idl::DriveType type_of(robot_file::DriveKind kind) {
  switch (kind) {
    case robot_file::DriveKind::differential: return idl::DIFFERENTIAL;
    case robot_file::DriveKind::synchro: return idl::SYNCHRO;
    case robot_file::DriveKind::holonomic: return idl::HOLONOMIC;
  }
  return idl::DIFFERENTIAL;
}

std::string all_of(const xml::Diagnostics& wrong) {
  std::string text;
  for (const xml::Diagnostic& one : wrong.sorted())
    if (one.severity == xml::Severity::error)
      text += (text.empty() ? "" : "; ") + one.position.text() + ": " + one.message;
  return text;
}

}  // namespace

Result<Machine> Machine::read(const std::string& path) {
  xml::Diagnostics wrong;
  const std::optional<Figures> robot = robot_file::read_figures(path, wrong);
  if (!robot) return fail(Code::invalid_argument, all_of(wrong));
  if (robot->fixed)
    return fail(Code::failed_precondition, in_quotes(path) + " is the file of something that does not move");
  std::vector<Solid> solids = body_of(*robot);
  append(robot->paddles, solids);
  std::vector<Solid> loaded = solids;
  append(robot->load, loaded);
  Machine machine{SweptBody(solids), SweptBody(loaded)};
  const robot_file::Drive& drive = robot->drive;
  machine.limits_ = {.max_speed = drive.max_speed,
                     .max_turn_rate = drive.max_turn_rate,
                     .steer_gain = drive.steer_gain,
                     .big_turn_angle = drive.big_turn_angle,
                     .big_turn_speed = drive.big_turn_speed,
                     .type = type_of(drive.kind)};
  machine.gentle_ = {drive.max_acceleration, drive.max_turn_acceleration};
  machine.hard_ = {std::max(drive.stop_deceleration, drive.max_acceleration), drive.max_turn_acceleration};
  machine.delay_ = to_seconds(drive.lag + drive.dead_time);
  return machine;
}

Rules Machine::rules(double reaction, double margin) const {
  return {.gentle = gentle_, .hard = hard_, .reaction = delay_ + reaction, .margin = margin};
}

}  // namespace orca::gate
