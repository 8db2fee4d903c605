// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/checks.hpp"

#include "orca/base/portable_math.hpp"
#include "orca/idl/moving.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

namespace orca {
namespace {

// [m], [rad], [m/s], [rad/s] Nothing that a robot has or does is larger; places of national grids are within it.
constexpr double kLargest = 1e7;
constexpr double kFastestOfAll = 100.0;   // [m/s], [rad/s] ten times what any robot of Orca does
constexpr double kFarthestSensor = 50.0;  // [m] from the middle of its robot
constexpr double kShortestView = 0.1;     // [m] By a sensor that sees less far nobody can drive.
constexpr double kLongestView = 1000.0;   // [m]
constexpr double kFarBeyond = 10.0;       // times max_range
constexpr double kLeastUpright = 0.5;  // share of a laser's own upward direction that is upward: up to 60 deg
constexpr double kLeastStep = 1e-6;    // [rad] from a beam to the next
constexpr double kLongestSweep = 10.0;                  // [s]
constexpr double kWidestScan = 4.0 * std::numbers::pi;  // [rad]

std::string in_digits(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

Error wrong(std::string text) { return fail(Code::invalid_argument, std::move(text)); }

// False for what is not a number, too.
bool is_possible(double number) { return std::abs(number) <= kLargest; }

// The usual reason for a sensor that is farther away is a length in millimetres: it would see nothing near the robot.
bool is_at_robot(double length) { return std::abs(length) <= kFarthestSensor; }

bool is_possible(const idl::Point& point, const idl::Rotation3D& rotation) {
  return is_at_robot(point.x()) && is_at_robot(point.y()) && is_at_robot(point.z()) &&
         is_possible(rotation.roll()) && is_possible(rotation.pitch()) && is_possible(rotation.yaw());
}

bool is_number(double range) { return !std::isnan(range); }

// Returns whether ranges differ where nothing can be measured any more. Whoever says by a number that there was no echo says always the same one;
// the usual reason for several is a length in millimetres, by which nothing would ever be near.
bool are_measured_far_beyond(const idl::RangeReadings& readings) {
  const double beyond = kFarBeyond * readings.max_range();
  const auto is_beyond = [&](double range) { return range > beyond && std::isfinite(range); };
  const auto first = std::ranges::find_if(readings.ranges(), is_beyond);
  return std::any_of(first, readings.ranges().end(),
                     [&](double range) { return is_beyond(range) && range != *first; });
}

// Checks the part that scans and rounds have in common.
Status check_ranges(const idl::RangeReadings& readings) {
  if (readings.ranges().empty()) return wrong("it has no ranges");
  if (std::ranges::none_of(readings.ranges(), is_number))
    return wrong("none of its " + std::to_string(readings.ranges().size()) + " ranges is a number");
  const double least = readings.min_range();
  const double most = readings.max_range();
  if (!(least >= 0.0 && least < most && most >= kShortestView && most <= kLongestView))
    return wrong("its limits are min_range " + in_digits(least) + " m and max_range " + in_digits(most) +
                 " m; expected 0 <= min_range < max_range, and max_range from 0.1 m to 1000 m");
  if (are_measured_far_beyond(readings))
    return wrong("its ranges are more than ten times its max_range of " + in_digits(most) +
                 " m, and differ: are they in millimetres?");
  if (!is_possible(readings.pose().position(), readings.pose().rotation()))
    return wrong(
        "its pose holds a number that is not finite, or of no possible size: it is the sensor's in the frame "
        "of the robot, in metres and radians");
  return ok();
}

// Checks a round of sensors that each have a pose. @param sensor  what each of them is, for people.
template <class Round>
Status check_round(const Round& round, const std::string& sensor) {
  if (Status sound = check_ranges(round); !sound.ok()) return sound;
  for (std::size_t i = 0; i < std::min(round.ranges().size(), round.poses().size()); ++i)
    if (is_number(round.ranges()[i]) && is_possible(round.poses()[i].position(), round.poses()[i].rotation()))
      return ok();
  return wrong("none of its " + std::to_string(round.ranges().size()) +
               " ranges is a number that comes with a finite pose of its " + sensor + "; it has " +
               std::to_string(round.poses().size()) + " poses");
}

std::optional<std::string> doubt_about_speed(double speed) {
  if (std::abs(speed) <= kFastest) return std::nullopt;
  return "a speed of " + in_digits(speed) + " m/s: was it meant in mm/s or cm/s?";
}

std::optional<std::string> doubt_about_turn(double rate) {
  if (std::abs(rate) <= kFastestTurn) return std::nullopt;
  return "a turn rate of " + in_digits(rate) + " rad/s: did you mean degrees?";
}

struct Quantity {
  const char* name;
  double value;
};

template <std::size_t Count>
Status check_motion(const Quantity (&quantities)[Count], const std::array<double, 9>& covariance) {
  for (const auto& [name, value] : quantities) {
    const bool is_speed = std::string_view(name).ends_with("_velocity");
    if (!(std::abs(value) <= (is_speed ? kFastestOfAll : kLargest)))
      return wrong("its " + std::string(name) + " is " + in_digits(value) + "; expected at most " +
                   (is_speed ? "100" : "1e7"));
  }
  if (!std::ranges::all_of(covariance, [](double entry) { return std::isfinite(entry); }))
    return wrong("its covariance holds a number that is not finite");
  for (const std::size_t variance : {0U, 4U, 8U})
    if (covariance[variance] < 0.0)
      return wrong("its covariance holds the negative variance " + in_digits(covariance[variance]));
  return ok();
}

}  // namespace

Status check_reading(const idl::LaserRangeReadings& scan) {
  if (Status sound = check_ranges(scan); !sound.ok()) return sound;
  const idl::Rotation3D& tilt = scan.pose().rotation();
  if (portable::cos(tilt.roll()) * portable::cos(tilt.pitch()) < kLeastUpright)
    return wrong(
        "its laser has a roll of " + in_digits(tilt.roll()) + " rad and a pitch of " +
        in_digits(tilt.pitch()) +
        " rad; expected one that lies level: one that hangs upside down reports its angles the other "
        "way round, and no roll");
  const double step = scan.angle_increment();
  const bool is_one = scan.ranges().size() == 1;
  const double width = std::abs(step) * static_cast<double>(scan.ranges().size() - 1);
  if (!is_possible(scan.angle_start()) ||
      !(is_one ? is_possible(step) : std::abs(step) >= kLeastStep && width <= kWidestScan))
    return wrong("its " + std::to_string(scan.ranges().size()) + " beams begin at " +
                 in_digits(scan.angle_start()) + " rad and are " + in_digits(step) +
                 " rad apart; expected finite angles that differ and span at most two turns");
  if (!is_possible(scan.time_increment()))
    return wrong("its time_increment is " + in_digits(scan.time_increment()) + " s; expected a finite time");
  if (std::fabs(scan.time_increment()) * static_cast<double>(scan.ranges().size()) > kLongestSweep)
    return wrong("its time_increment is " + in_digits(scan.time_increment()) + " s for each of " +
                 std::to_string(scan.ranges().size()) + " beams; expected a sweep of at most 10 s");
  return ok();
}

Status check_reading(const idl::SonarRangeReadings& round) { return check_round(round, "sonar"); }

Status check_reading(const idl::InfraredRangeReadings& round) {
  return check_round(round, "infrared sensor");
}

Status check_reading(const idl::RobotPose& pose) {
  return check_motion({{"x", pose.x()},
                       {"y", pose.y()},
                       {"orientation", pose.orientation()},
                       {"translational_velocity", pose.translational_velocity()},
                       {"sideways_velocity", pose.sideways_velocity()},
                       {"steering_velocity", pose.steering_velocity()}},
                      pose.covariance());
}

Status check_reading(const idl::Odometry& odometry) {
  return check_motion({{"x", odometry.x()},
                       {"y", odometry.y()},
                       {"steer_angle", odometry.steer_angle()},
                       {"translational_velocity", odometry.translational_velocity()},
                       {"sideways_velocity", odometry.sideways_velocity()},
                       {"steering_velocity", odometry.steering_velocity()}},
                      odometry.covariance());
}

Status check_reading(const idl::Teammate& mate) {
  return check_motion({{"x", mate.pose().x()},
                       {"y", mate.pose().y()},
                       {"orientation", mate.pose().orientation()},
                       {"translational_velocity", mate.translational_velocity()},
                       {"sideways_velocity", mate.sideways_velocity()}},
                      mate.pose().covariance());
}

std::optional<std::string> doubt_about(const idl::MotionCommand& command) {
  if (command.kind() != idl::NORMAL) return std::nullopt;
  if (auto doubt = doubt_about_speed(command.speed())) return doubt;
  if (command.steering() == idl::BY_TURN_RATE) return doubt_about_turn(command.turn_rate());
  if (std::abs(command.direction()) <= 2.0 * std::numbers::pi) return std::nullopt;
  return "a direction of " + in_digits(command.direction()) + " rad: did you mean degrees?";
}

std::optional<std::string> doubt_about(const idl::HolonomicVelocity& velocity) {
  for (const double speed : {velocity.speed(), velocity.left()})
    if (auto doubt = doubt_about_speed(speed)) return doubt;
  return doubt_about_turn(velocity.turn_rate());
}

Status check_reading(const idl::MovingThings& moving) {
  for (const idl::MovingThing& thing : moving.things()) {
    const Quantity places[] = {{"x", thing.x()},
                               {"y", thing.y()},
                               {"velocity_x", thing.velocity_x()},
                               {"velocity_y", thing.velocity_y()}};
    const Quantity sizes[] = {{"radius", thing.radius()},
                              {"place_error", thing.place_error()},
                              {"velocity_error", thing.velocity_error()},
                              {"unseen", thing.unseen()}};
    const std::string whose = " of its thing " + std::to_string(thing.number()) + " is ";
    for (const auto& [name, value] : places)
      if (!is_possible(value)) return wrong(name + whose + in_digits(value) + "; expected at most 1e7");
    for (const auto& [name, value] : sizes)
      if (!(value >= 0.0 && is_possible(value)))
        return wrong(name + whose + in_digits(value) + "; expected 0 to 1e7");
  }
  return ok();
}

}  // namespace orca
