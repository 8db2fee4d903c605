// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/base_params.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"

namespace orca::hw {
namespace {

constexpr double kTrackTolerance = 0.005;  // [m]
constexpr std::string_view kOrOfFile = " Not set: as `robot` says, if that names a file.";

std::string or_of_file(std::string_view text) { return std::string(text) + std::string(kOrOfFile); }

idl::DriveType type_of(robots::DriveKind kind) {
  switch (kind) {
    case robots::DriveKind::differential: return idl::DIFFERENTIAL;
    case robots::DriveKind::synchro: return idl::SYNCHRO;
    case robots::DriveKind::holonomic: return idl::HOLONOMIC;
  }
  return idl::DIFFERENTIAL;
}

std::string_view word_for(idl::DriveType type) {
  switch (type) {
    case idl::DIFFERENTIAL: return "differential";
    case idl::SYNCHRO: return "synchro";
    default: return "holonomic";
  }
}

bool is_one_word(const std::string& name) {
  return !name.empty() && name.find(' ') == std::string::npos && printable(name) == name;
}

void append(std::vector<HardwareFault>& to, std::vector<HardwareFault> more) {
  for (HardwareFault& fault : more) to.push_back(std::move(fault));
}

// Adds what the file says of a ring that the driver describes. Where its sonars are, the readings say.
void complete_ring(const robots::SonarRing& ring, idl::SonarRing& described) {
  if (described.vendor().empty()) described.vendor(ring.label.vendor);
  if (described.model().empty()) described.model(ring.label.model);
  if (described.half_lobe() == 0.0) described.half_lobe(ring.half_lobe);
  if (described.radius() == 0.0 && ring.positions.empty()) described.radius(ring.radius);
}

}  // namespace

BaseParams::BaseParams(HardwareContainer& owner, const OwnFigures& own)
    : own_(own),
      file_(owner),
      name_(owner, "name", own.name, {.text = or_of_file("Name of this robot, one word.")}),
      max_speed_(owner, "max_speed", own.max_speed,
                 {.unit = "m/s", .min = 0.0, .max = own.most_speed, .text = or_of_file("Greatest speed.")}),
      max_turn_rate_(owner, "max_turn_rate", own.max_turn_rate,
                     {.unit = "rad/s",
                      .min = 0.0,
                      .max = own.most_turn_rate,
                      .text = or_of_file("Greatest turn rate.")}),
      steer_gain_(owner, "steer_gain", own.steer_gain,
                  {.min = 0.0,
                   .text = or_of_file(
                       "Turn rate per angle off the wanted direction, in 1/s. A smaller one is calmer.")}) {}

void BaseParams::limit(double speed, double turn_rate) {
  if (speed > 0.0) own_.most_speed = speed;
  if (turn_rate > 0.0) own_.most_turn_rate = turn_rate;
}

std::vector<HardwareFault> BaseParams::read() {
  std::vector<HardwareFault> faults = file_.read();
  const robots::Characteristics* const robot = file_.robot();
  if (robot == nullptr) return faults;
  if (is_one_word(robot->name)) name_.take_from_file(robot->name);
  steer_gain_.take_from_file(robot->drive.steer_gain);
  append(faults, wrong_kind());
  append(faults, wrong_track());
  append(faults, wrong_sonars());
  append(faults, file_.give(max_speed_, robot->drive.max_speed, "max_speed of the <drive>", own_.most_speed));
  append(faults, file_.give(max_turn_rate_, robot->drive.max_turn_rate, "max_steer_speed of the <drive>",
                            own_.most_turn_rate));
  return faults;
}

std::vector<HardwareFault> BaseParams::wrong_kind() const {
  const idl::DriveType type = type_of(file_.robot()->drive.kind);
  if (type == own_.type) return {};
  return {{"robot", "the robot of " + file_.shown() + " has a drive of type " + std::string(word_for(type)) +
                        ", and this driver drives a " + std::string(word_for(own_.type)) +
                        " one; name the file of the robot that is at this line"}};
}

std::vector<HardwareFault> BaseParams::wrong_track() const {
  const double track = file_.robot()->drive.track;
  if (!own_.fixed_track || std::abs(track - *own_.fixed_track) <= kTrackTolerance) return {};
  return {{.param = "robot",
           .text = "track of the <drive> in " + file_.shown() + " is " + xml::number_text(track) +
                   " m, but this driver computes with " + xml::number_text(*own_.fixed_track) +
                   " m, which all its robots have; correct the file, or name that of the robot at this line",
           .only_warns = true}};
}

std::vector<HardwareFault> BaseParams::wrong_sonars() const {
  if (!own_.sonars || sonars() == 0 || sonars() == *own_.sonars) return {};
  return {{.param = "robot",
           .text = "the robot of " + file_.shown() + " has " + std::to_string(sonars()) +
                   " sonars, and each robot of this driver has " + std::to_string(*own_.sonars) +
                   "; name the file of the robot that is at this line",
           .only_warns = true}};
}

std::vector<HardwareFault> BaseParams::give(FileParam<double>& param, double robots::Drive::*figure,
                                            const std::string& attribute) const {
  if (file_.robot() == nullptr) return {};
  return file_.give(param, file_.robot()->drive.*figure, attribute + " of the <drive>");
}

DriveLimits BaseParams::limits() const {
  const auto at_most = [](double value, const std::optional<double>& most) {
    return most ? std::min(value, *most) : value;
  };
  DriveLimits limits{.max_speed = at_most(*max_speed_, own_.most_speed),
                     .max_turn_rate = at_most(*max_turn_rate_, own_.most_turn_rate),
                     .steer_gain = *steer_gain_,
                     .big_turn_angle = own_.big_turn_angle,
                     .big_turn_speed = own_.big_turn_speed,
                     .type = own_.type};
  if (const robots::Characteristics* const robot = file_.robot(); robot != nullptr) {
    limits.big_turn_angle = robot->drive.big_turn_angle;
    limits.big_turn_speed = robot->drive.big_turn_speed;
  }
  return limits;
}

std::size_t BaseParams::sonars() const {
  std::size_t count = 0;
  if (file_.robot() != nullptr)
    for (const robots::SonarRing& ring : file_.robot()->sonars) count += ring.count;
  return count;
}

void BaseParams::complete(idl::Robot& described) const {
  const robots::Characteristics* const robot = file_.robot();
  if (robot == nullptr) return;
  if (!robot->vendor.empty()) described.vendor(robot->vendor);
  if (!robot->model.empty()) described.model(robot->model);
  described.radius(robot->radius);
  described.bumper_radius(robot->bumper_radius);
  idl::Drive& drive = described.drives().front();
  drive.vendor(robot->drive.label.vendor);
  drive.model(robot->drive.label.model);
  if (drive.speed_change() == 0.0) drive.speed_change(robot->drive.max_acceleration);
  for (idl::SonarRing& ring : described.sonar_rings())
    if (robot->sonars.size() == 1 && robot->sonars.front().count == ring.number())
      complete_ring(robot->sonars.front(), ring);
}

}  // namespace orca::hw
