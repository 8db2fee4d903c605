// SPDX-License-Identifier: GPL-3.0-or-later
// The goals that Goto refuses, and the ones that it must not.
#include <catch2/catch.hpp>

#include <limits>
#include <numbers>

#include "orca/goals/route.hpp"

using namespace orca;
using namespace orca::go;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kHalfTurn = std::numbers::pi;

struct Case {
  const char* fault;  // Empty: none.
  void (*change)(idl::GoalPoint&);
};

// A goal on the floor, to be faced to the north within 0.1 rad.
idl::GoalPoint good() {
  idl::GoalPoint goal;
  goal.reach_radius().distance(0.2);
  goal.use_orientation(true);
  goal.orientation().orientation().yaw(kHalfTurn / 2);
  goal.reach_angle(0.1);
  return goal;
}

}  // namespace

TEST_CASE("a goal that no robot on the floor can take is refused with the reason", "[goto][fault]") {
  const auto [fault, change] = GENERATE(values<Case>({
      {"", [](idl::GoalPoint&) {}},
      {"not finite", [](idl::GoalPoint& goal) { goal.coordinate().point().y(kNan); }},
      {"farther away than any place", [](idl::GoalPoint& goal) { goal.coordinate().point().x(1e300); }},
      {"farther away than any place", [](idl::GoalPoint& goal) { goal.coordinate().point().y(-1e9); }},
      {"not finite", [](idl::GoalPoint& goal) { goal.orientation().orientation().yaw(kNan); }},
      {"not finite", [](idl::GoalPoint& goal) { goal.orientation().orientation().roll(kNan); }},
      {"not finite", [](idl::GoalPoint& goal) { goal.reach_radius().distance(kNan); }},
      {"negative reach_radius", [](idl::GoalPoint& goal) { goal.reach_radius().distance(-0.1); }},
      {"time_limit that is negative", [](idl::GoalPoint& goal) { goal.time_limit(kNan); }},
      {"time_limit that is negative", [](idl::GoalPoint& goal) { goal.time_limit(-0.1); }},
      {"", [](idl::GoalPoint& goal) { goal.time_limit(0.0); }},
      {"", [](idl::GoalPoint& goal) { goal.reach_radius().distance(0.0); }},
      {"", [](idl::GoalPoint& goal) { goal.reach_radius().uncertainty(0.5); }},
      {"not positive", [](idl::GoalPoint& goal) { goal.reach_angle(0.0); }},
      {"rolls or pitches", [](idl::GoalPoint& goal) { goal.orientation().orientation().pitch(0.2); }},
      {"rolls or pitches", [](idl::GoalPoint& goal) { goal.orientation().orientation().roll(-kHalfTurn); }},
      {"", [](idl::GoalPoint& goal) { goal.orientation().orientation().roll(0.05); }},
      {"", [](idl::GoalPoint& goal) { goal.orientation().orientation().roll(2 * kHalfTurn); }},
      {"",
       [](idl::GoalPoint& goal) {
         goal.orientation().orientation().pitch(0.2);
         goal.use_orientation(false);
       }},
      {"above or below", [](idl::GoalPoint& goal) { goal.coordinate().point().z(0.5); }},
      {"", [](idl::GoalPoint& goal) { goal.coordinate().point().z(0.1); }},
  }));
  idl::GoalPoint goal = good();
  change(goal);
  CAPTURE(fault);
  const char* found = fault_of(goal, 0.0);
  CHECK((found != nullptr) == !std::string(fault).empty());
  if (found != nullptr) CHECK_THAT(found, Catch::Contains(fault));
}

TEST_CASE("a door of negative width is no door of which nobody knows the width", "[goto][fault]") {
  idl::Door door;
  door.passable(true);
  CHECK(fault_of_door(door, 0.5) == nullptr);
  door.door_width().distance(-1.0);
  CHECK_THAT(fault_of_door(door, 0.5), Catch::Contains("negative width"));
}
