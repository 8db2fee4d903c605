// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/geometry/objects/description.hpp"

#include <cstdio>
#include <string>

#include "orca/base/text.hpp"

namespace orca {
namespace {

constexpr double kLargest = 50.0;          // [m] as far as a sensor may be from the middle of its robot
constexpr double kFastestOfAll = 1000.0;   // [m/s], [rad/s], [m/s2]
constexpr double kLongestInterval = 60.0;  // [s] between two readings of a sensor to drive by

std::string in_digits(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", number);
  return text;
}

// Checks one figure. @param unit  of it, and of `most`.
Status check_figure(const std::string& name, double value, double most, const char* unit) {
  if (value >= 0.0 && value <= most) return ok();
  return fail(Code::invalid_argument, "its " + name + " is " + in_digits(value) + " " + unit +
                                          "; expected 0 to " + in_digits(most) + " " + unit);
}

Status check_drive(const idl::Drive& drive) {
  if (Status sound = check_figure("max_speed", drive.max_speed(), kFastestOfAll, "m/s"); !sound.ok())
    return sound;
  if (Status sound = check_figure("max_steer_speed", drive.max_steer_speed(), kFastestOfAll, "rad/s");
      !sound.ok())
    return sound;
  return check_figure("speed_change", drive.speed_change(), kFastestOfAll, "m/s2");
}

Status check_size(const idl::Robot& robot) {
  if (!(robot.radius() > 0.0))
    return fail(Code::invalid_argument, "its radius is " + in_digits(robot.radius()) +
                                            " m; expected that of the circle that holds its body");
  if (Status sound = check_figure("radius", robot.radius(), kLargest, "m"); !sound.ok()) return sound;
  if (Status sound = check_figure("bumper_radius", robot.bumper_radius(), kLargest, "m"); !sound.ok())
    return sound;
  if (Status sound = check_figure("length", robot.length(), 2.0 * kLargest, "m"); !sound.ok()) return sound;
  return check_figure("width", robot.width(), 2.0 * kLargest, "m");
}

template <class Sensors>
Status check_intervals(const Sensors& sensors) {
  for (const idl::Sensor& sensor : sensors)
    if (Status sound = check_figure("sensor " + in_quotes(sensor.name()) + "'s update_interval",
                                    sensor.update_interval(), kLongestInterval, "s");
        !sound.ok())
      return sound;
  return ok();
}

Status check_all(const idl::Robot& robot) {
  if (Status sound = check_size(robot); !sound.ok()) return sound;
  for (const idl::Drive& drive : robot.drives())
    if (Status sound = check_drive(drive); !sound.ok()) return sound;
  if (Status sound = check_intervals(robot.sonar_rings()); !sound.ok()) return sound;
  return check_intervals(robot.laser_sensors());
}

}  // namespace

Status check_description(const idl::Robot& robot) {
  const Status sound = check_all(robot);
  if (sound.ok()) return ok();
  return fail(sound.error().code, "the base describes no robot that there can be: " + sound.error().message);
}

}  // namespace orca
