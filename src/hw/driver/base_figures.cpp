// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/base_figures.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/text.hpp"
#include "orca/geometry/usual_figures.hpp"
#include "orca/hw/description.hpp"
#include "orca/xml/number.hpp"

namespace orca::hw {
namespace {

constexpr double kOtherRobot = 1.25;  // ratio of two tracks that are not those of one robot

double rounded(double metres) { return 0.001 * std::round(1000.0 * metres); }

bool are_far_apart(double track, double expected) {
  return expected > 0.0 && (track > kOtherRobot * expected || expected > kOtherRobot * track);
}

}  // namespace

std::vector<HardwareFault> BaseFigures::read(const Expected& expected) {
  std::vector<HardwareFault> faults;
  figures_ = read_robot_figures(*file_, faults);
  if (!figures_) return faults;
  type_ = expected.type;
  const robot_file::Drive& drive = figures_->drive;
  if (figures_->fixed)
    faults.push_back({"robot", in_quotes(*file_) + " has no <drive>: it is no file of a robot that moves"});
  else if (to_string(drive.kind) != name_of(expected.type))
    faults.push_back({"robot", in_quotes(*file_) + " is the file of a robot whose drive is " +
                                   std::string(to_string(drive.kind)) + ", and the drive of this one is " +
                                   name_of(expected.type)});
  else if (are_far_apart(drive.track, expected.track))
    faults.push_back({.param = "robot",
                      .text = in_quotes(*file_) + " has a track of " + xml::number_text(drive.track) +
                              " m, and a " + expected.model + " has one of about " +
                              xml::number_text(rounded(expected.track)) +
                              " m; is it the file of another robot?",
                      .only_warns = true});
  if (!figures_->usual.empty())
    faults.push_back(
        {.param = "robot", .text = in_quotes(*file_) + ": " + figures_->usual, .only_warns = true});
  return faults;
}

DriveLimits BaseFigures::within(DriveLimits limits) const {
  if (!figures_) return limits;
  const robot_file::Drive& drive = figures_->drive;
  limits.max_speed = std::min(limits.max_speed, drive.max_speed);
  limits.max_turn_rate = std::min(limits.max_turn_rate, drive.max_turn_rate);
  limits.steer_gain = drive.steer_gain;
  limits.big_turn_angle = drive.big_turn_angle;
  limits.big_turn_speed = drive.big_turn_speed;
  return limits;
}

double BaseFigures::within(double acceleration) const {
  return figures_ ? std::min(acceleration, figures_->drive.max_acceleration) : acceleration;
}

void BaseFigures::describe(idl::Robot& robot) const {
  if (!figures_) return;
  robot.radius(figures_->radius);
  robot.bumper_radius(figures_->bumper_radius);
  if (!figures_->size) return;
  robot.length(figures_->size->x);
  robot.width(figures_->size->y);
}

SenseTraits BaseFigures::traits() const {
  SenseTraits traits{.calibration = calibration()};
  if (!figures_) return traits;
  const auto known = std::ranges::find_if(
      figures_->sonars, [](const robot_file::SonarRing& ring) { return ring.errors.general().is_known(); });
  if (known != figures_->sonars.end()) traits.sonars = known->errors.general();
  WheelErrorGuess wheels;
  if (figures_->odometer) wheels = figures_->odometer->errors.general();
  traits.odometry.emplace(type_, figures_->drive.track, wheels.is_known() ? wheels : kUsualWheelErrors);
  return traits;
}

}  // namespace orca::hw
