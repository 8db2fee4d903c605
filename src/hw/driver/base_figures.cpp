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
  if (!figures_->wheels)
    faults.push_back({"robot", in_quotes(*file_) + " has no <drive>: it is no file of a robot that moves"});
  else if (figures_->wheels->type != expected.type)
    faults.push_back({"robot", in_quotes(*file_) + " is the file of a robot whose drive is " +
                                   name_of(figures_->wheels->type) + ", and the drive of this one is " +
                                   name_of(expected.type)});
  else if (are_far_apart(figures_->wheels->track, expected.track))
    faults.push_back({.param = "robot",
                      .text = in_quotes(*file_) + " has a track of " +
                              xml::number_text(figures_->wheels->track) + " m, and a " + expected.model +
                              " has one of about " + xml::number_text(rounded(expected.track)) +
                              " m; is it the file of another robot?",
                      .only_warns = true});
  if (const std::string text = usual_figures_text(false, !figures_->says_wheel_errors); !text.empty())
    faults.push_back({.param = "robot", .text = in_quotes(*file_) + ": " + text, .only_warns = true});
  return faults;
}

DriveLimits BaseFigures::within(DriveLimits limits) const {
  if (!figures_ || !figures_->wheels) return limits;
  const RobotFigures::Wheels& wheels = *figures_->wheels;
  limits.max_speed = std::min(limits.max_speed, wheels.max_speed);
  limits.max_turn_rate = std::min(limits.max_turn_rate, wheels.max_turn_rate);
  limits.steer_gain = wheels.steer_gain.value_or(limits.steer_gain);
  limits.big_turn_angle = wheels.big_turn_angle.value_or(limits.big_turn_angle);
  limits.big_turn_speed = wheels.big_turn_speed.value_or(limits.big_turn_speed);
  return limits;
}

double BaseFigures::within(double acceleration) const {
  if (!figures_ || !figures_->wheels) return acceleration;
  return std::min(acceleration, figures_->wheels->max_acceleration);
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
  traits.sonars = figures_->sonar_errors;
  if (figures_->wheels && figures_->wheel_errors.is_known())
    traits.odometry.emplace(figures_->wheels->type, figures_->wheels->track, figures_->wheel_errors);
  return traits;
}

}  // namespace orca::hw
