// SPDX-License-Identifier: GPL-3.0-or-later
// What a VfhPlus advises on scans that the test makes up.
#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <numbers>

#include "orca/base/random.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/testing/component_trial.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kFar = 8.0;  // [m] of the laser

// Returns the range of the beam at an angle [rad] of the sensor, which looks as the robot does.
using Shape = std::function<double(double angle)>;

const Shape kNothing = [](double) { return kFar; };

// A wall across the way, `distance` [m] ahead, from y = right to y = left [m].
Shape wall(double distance, double right, double left) {
  return [=](double angle) {
    const double y = distance * std::tan(angle);
    return std::abs(angle) < 89 * kDegree && y >= right && y <= left ? distance / std::cos(angle) : kFar;
  };
}

struct Pioneer final : Partner {
  using Partner::Partner;
  PushServer<idl::LaserRangeReadings> laser{*this, "laser"};
  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushServer<idl::GoalPoint> goal{*this, "goal"};
  PushProxy<idl::MotionCommand> motion{*this, "motion"};

  // Scans all round, a beam a degree.
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

  void drive_to(double x, double y) {
    auto place = goal.loan();
    place->coordinate().point().x(x);
    place->coordinate().point().y(y);
    goal.push(std::move(place));
  }

  // Stands at the origin, turned by `yaw` [rad], and returns what is advised.
  // @param turn_rate  [rad/s] that its odometry reports: one that stands still for a second backs off.
  ObjectPtr<idl::MotionCommand> stand(double yaw = 0.0, double turn_rate = 0.0) {
    auto here = odometry.loan();
    here->steer_angle(yaw);
    here->steering_velocity(turn_rate);
    here->stamp(to_time_value(now()));
    odometry.push(std::move(here));
    return motion.get_update_wait();
  }
};

ObjectPtr<idl::MotionCommand> advice_on(const Shape& shape, double goal_y, double yaw = 0.0,
                                        double goal_x = 5.0) {
  ObjectPtr<idl::MotionCommand> advice;
  try_component<Pioneer>({.type = "orca.VfhPlus"}, [&](Pioneer& test) {
    test.scan(shape);
    test.drive_to(goal_x, goal_y);
    advice = test.stand(yaw);
  });
  return advice;
}

}  // namespace

TEST_CASE("VfhPlus has no opinion while the ways ahead and to the goal are free", "[testing][vfh]") {
  CHECK(advice_on(kNothing, 0.0)->kind() == idl::MotionKind::DONTCARE);
  CHECK(advice_on(wall(3.0, -1.0, 1.0), 0.0)->kind() == idl::MotionKind::DONTCARE);
}

TEST_CASE("VfhPlus leads past a wall ahead on the side of the goal, the slower the nearer it is",
          "[testing][vfh]") {
  const auto left = advice_on(wall(0.8, -0.3, 0.3), 1.0);
  const auto right = advice_on(wall(0.8, -0.3, 0.3), -1.0);
  const auto near = advice_on(wall(0.6, -0.3, 0.3), 1.0);
  CHECK(left->kind() == idl::MotionKind::NORMAL);
  CHECK(left->direction() > 45 * kDegree);
  CHECK(right->direction() < -45 * kDegree);
  CHECK(left->speed() > 0.0);
  CHECK(near->speed() < left->speed());
  CHECK(near->weight() > left->weight());
}

TEST_CASE("VfhPlus goes on leading round what is in the way to the goal after the robot has turned away",
          "[testing][vfh]") {
  const double yaw = 80 * kDegree;
  const Shape beside = [&](double angle) {
    return wall(0.7, -0.3, 0.3)(std::remainder(angle + yaw, 2 * std::numbers::pi));
  };
  const auto advice = advice_on(beside, 0.0, yaw);
  CHECK(advice->kind() == idl::MotionKind::NORMAL);
  CHECK(advice->direction() > -30 * kDegree);  // not back to the goal, which is 80 degrees to the right
  CHECK(advice->speed() == 0.4);               // the way ahead is free
}

TEST_CASE("VfhPlus lets the robot come to a goal in front of a wall, slowly", "[testing][vfh]") {
  const Shape in_front_of_a_wall = wall(0.9, -3.0, 3.0);
  const auto before_it = advice_on(in_front_of_a_wall, 0.0, 0.0, 0.4);
  CHECK(before_it->kind() == idl::MotionKind::NORMAL);
  CHECK(before_it->direction() == 0.0);
  CHECK(before_it->speed() > 0.1);
  CHECK(before_it->speed() < 0.4);
  CHECK(std::abs(advice_on(in_front_of_a_wall, 0.0)->direction()) > 45 * kDegree);  // a goal behind it
}

TEST_CASE("VfhPlus stands where it is closed in", "[testing][vfh]") {
  const auto advice = advice_on([](double) { return 0.6; }, 0.0);
  CHECK(advice->kind() == idl::MotionKind::NORMAL);
  CHECK(advice->speed() == 0.0);
  CHECK(advice->direction() == 0.0);
  CHECK(advice->weight() == Approx(2000.0));
}

TEST_CASE("VfhPlus keeps to the side that it has chosen, however its laser trembles", "[testing][vfh]") {
  RandomStream random(1, "test", "tremble");
  std::vector<double> directions;
  try_component<Pioneer>({.type = "orca.VfhPlus"}, [&](Pioneer& test) {
    for (int i = 0; i < 100; ++i) {
      test.scan(wall(0.75 + random.normal(0.0, 0.01), -0.3 + random.normal(0.0, 0.05),
                     0.3 + random.normal(0.0, 0.05)));
      test.drive_to(5.0, 0.0);
      directions.push_back(test.stand(0.0, 0.02)->direction());
      test.sleep(100ms);
    }
  });
  const bool to_left = directions.front() > 0.0;
  for (const double direction : directions) {
    CHECK(std::abs(direction) > 30 * kDegree);
    CHECK((direction > 0.0) == to_left);
  }
}

TEST_CASE("VfhPlus starts anew when it is used again after a pause without clients", "[testing][vfh]") {
  const Shape between_thresholds = wall(0.957, 0.0, 0.0);
  const auto first = advice_on(between_thresholds, 0.0);
  ObjectPtr<idl::MotionCommand> again;
  try_component<Pioneer>({.type = "orca.VfhPlus"}, [&](Pioneer& test) {
    test.scan(wall(0.6, -0.3, 0.3));
    test.drive_to(5.0, 0.0);
    static_cast<void>(test.stand());
    test.motion.unsubscribe();
    test.sleep(100ms);
    test.motion.subscribe();
    test.sleep(100ms);
    test.scan(between_thresholds);
    test.drive_to(5.0, 0.0);
    again = test.stand();
  });
  CHECK(first->kind() == idl::MotionKind::NORMAL);
  CHECK(first->direction() == 0.0);
  CHECK(again->direction() == 0.0);  // and not aside, as if it was still blocked
}

TEST_CASE("VfhPlus stops the robot when its laser is silent", "[testing][vfh]") {
  ObjectPtr<idl::MotionCommand> deaf;
  try_component<Pioneer>({.type = "orca.VfhPlus"}, [&](Pioneer& test) {
    test.scan(kNothing);
    static_cast<void>(test.stand());
    test.sleep(700ms);
    deaf = test.stand();
  });
  CHECK(deaf->kind() == idl::MotionKind::FULLSTOP);
}

TEST_CASE("VfhPlus refuses thresholds the wrong way round", "[testing][vfh]") {
  const Trial trial{.type = "orca.VfhPlus", .params = {{"threshold_low", "3"}, {"threshold_high", "2"}}};
  CHECK_THROWS_WITH(try_component<Pioneer>(trial, [](Pioneer& /*test*/) {}),
                    Contains("\"threshold_low\": it must not be above threshold_high"));
}
