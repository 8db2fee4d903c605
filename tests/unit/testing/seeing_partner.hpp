// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <functional>
#include <numbers>

#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/testing/component_trial.hpp"

namespace orca::testing {

inline constexpr double kDegree = std::numbers::pi / 180;
inline constexpr double kFar = 8.0;  ///< [m] of the laser

/// Returns the range of the beam at an angle [rad] of the sensor, which looks as the robot does.
using Shape = std::function<double(double angle)>;

inline const Shape kNothing = [](double) { return kFar; };

/// Returns a wall across the way, `distance` [m] ahead, from y = right to y = left [m].
inline Shape wall(double distance, double right, double left) {
  return [=](double angle) {
    const double y = distance * std::tan(angle);
    return std::abs(angle) < 89 * kDegree && y >= right && y <= left ? distance / std::cos(angle) : kFar;
  };
}

/// A partner that is all that an avoid behaviour hears: the laser, the odometry, and who says where to drive.
struct SeeingPartner final : Partner {
  using Partner::Partner;
  PushServer<idl::LaserRangeReadings> laser{*this, "laser"};
  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushServer<idl::GoalPoint> goal{*this, "goal"};
  PushProxy<idl::MotionCommand> motion{*this, "motion"};

  /// Scans all round, a beam a degree.
  void scan(const Shape& shape) {
    auto readings = laser.loan();
    readings->min_range(0.02);
    readings->max_range(kFar);
    readings->angle_start(-180 * kDegree);
    readings->angle_increment(kDegree);
    for (int i = 0; i < 360; ++i) readings->ranges().push_back(shape((i - 180) * kDegree));
    readings->stamp(to_time_value(now()));
    laser.push(std::move(readings));
  }

  void drive_to(double x, double y, double reach = 0.0) {
    auto place = goal.loan();
    place->coordinate().point().x(x);
    place->coordinate().point().y(y);
    place->reach_radius().distance(reach);
    goal.push(std::move(place));
  }

  /// Reports that the robot is at the origin, and returns what is advised.
  /// @param turn_rate  [rad/s] a robot that stands still for a second backs off.
  ObjectPtr<idl::MotionCommand> at_origin(double yaw = 0.0, double turn_rate = 0.0, double speed = 0.0) {
    auto here = odometry.loan();
    here->steer_angle(yaw);
    here->steering_velocity(turn_rate);
    here->translational_velocity(speed);
    here->stamp(to_time_value(now()));
    odometry.push(std::move(here));
    return motion.get_update_wait();
  }
};

}  // namespace orca::testing
