// SPDX-License-Identifier: GPL-3.0-or-later
// What a VfhPlus advises on scans that the test makes up.
#include <catch2/catch.hpp>

#include <cmath>

#include "orca/base/random.hpp"
#include "seeing_partner.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

ObjectPtr<idl::MotionCommand> advice_on(const Shape& shape, double goal_y, double yaw = 0.0,
                                        double goal_x = 5.0) {
  ObjectPtr<idl::MotionCommand> advice;
  try_component<SeeingPartner>({.type = "orca.VfhPlus"}, [&](SeeingPartner& test) {
    test.scan(shape);
    test.drive_to(goal_x, goal_y);
    advice = test.at_origin(yaw);
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
  try_component<SeeingPartner>({.type = "orca.VfhPlus"}, [&](SeeingPartner& test) {
    for (int i = 0; i < 100; ++i) {
      test.scan(wall(0.75 + random.normal(0.0, 0.01), -0.3 + random.normal(0.0, 0.05),
                     0.3 + random.normal(0.0, 0.05)));
      test.drive_to(5.0, 0.0);
      directions.push_back(test.at_origin(0.0, 0.02)->direction());
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
  try_component<SeeingPartner>({.type = "orca.VfhPlus"}, [&](SeeingPartner& test) {
    test.scan(wall(0.6, -0.3, 0.3));
    test.drive_to(5.0, 0.0);
    static_cast<void>(test.at_origin());
    test.motion.unsubscribe();
    test.sleep(100ms);
    test.motion.subscribe();
    test.sleep(100ms);
    test.scan(between_thresholds);
    test.drive_to(5.0, 0.0);
    again = test.at_origin();
  });
  CHECK(first->kind() == idl::MotionKind::NORMAL);
  CHECK(first->direction() == 0.0);
  CHECK(again->direction() == 0.0);  // and not aside, as if it was still blocked
}

TEST_CASE("VfhPlus stops the robot when its laser is silent", "[testing][vfh]") {
  ObjectPtr<idl::MotionCommand> deaf;
  try_component<SeeingPartner>({.type = "orca.VfhPlus"}, [&](SeeingPartner& test) {
    test.scan(kNothing);
    static_cast<void>(test.at_origin());
    test.sleep(700ms);
    deaf = test.at_origin();
  });
  CHECK(deaf->kind() == idl::MotionKind::FULLSTOP);
}

TEST_CASE("VfhPlus refuses thresholds the wrong way round", "[testing][vfh]") {
  const Trial trial{.type = "orca.VfhPlus", .params = {{"threshold_low", "3"}, {"threshold_high", "2"}}};
  CHECK_THROWS_WITH(try_component<SeeingPartner>(trial, [](SeeingPartner& /*test*/) {}),
                    Contains("\"threshold_low\": it must not be above threshold_high"));
}
