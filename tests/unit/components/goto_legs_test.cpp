// SPDX-License-Identifier: GPL-3.0-or-later
// The places through which Goto drives to a point, above all to a door.
#include <catch2/catch.hpp>

#include <numbers>

#include "orca/goals/legs.hpp"

using namespace orca;
using namespace orca::go;
using Catch::Detail::Approx;
using std::numbers::pi;

namespace {

constexpr Manner kManner{.height = 0.0, .run_up = 0.7};

// A door at (2, 4.5) that leads north, in a wall from west to east.
Route::Point door(bool via) {
  auto made = make_object<idl::Door>();
  made->coordinate().point().x(2.0);
  made->coordinate().point().y(4.5);
  made->orientation().orientation().yaw(pi / 2);
  made->reach_radius().distance(0.3);
  made->via(via);
  return ObjectPtr<idl::Door>(std::move(made).seal());
}

Route::Point place(double x, double y) {
  auto made = make_object<idl::GoalPoint>();
  made->coordinate().point().x(x);
  made->coordinate().point().y(y);
  made->reach_radius().distance(0.2);
  return std::move(made).seal();
}

void check_at(const Target& target, double x, double y) {
  CHECK(target.place.x == Approx(x));
  CHECK(target.place.y == Approx(y));
}

}  // namespace

TEST_CASE("the way to an ordinary point is the point itself", "[components][goto]") {
  const auto legs = legs_to(place(3.0, 1.0), {9.0, 9.0, 1.0}, kManner);
  REQUIRE(legs.size() == 1);
  check_at(legs[0], 3.0, 1.0);
  CHECK(legs[0].reach_radius == 0.2);
  CHECK_FALSE(legs[0].via);
}

TEST_CASE("through a door the robot lines up on its side and drives to the other", "[components][goto]") {
  const auto northwards = legs_to(door(true), {0.5, 2.0, 0.0}, kManner);
  REQUIRE(northwards.size() == 2);
  check_at(northwards[0], 2.0, 3.8);
  check_at(northwards[1], 2.0, 5.2);
  CHECK((northwards[0].via && northwards[1].via));
  CHECK(northwards[0].reach_radius == 0.1);
  const auto southwards = legs_to(door(true), {3.5, 6.0, 0.0}, kManner);
  REQUIRE(southwards.size() == 2);
  check_at(southwards[0], 2.0, 5.2);
  check_at(southwards[1], 2.0, 3.8);
}

TEST_CASE("a door as the goal is reached in its middle", "[components][goto]") {
  const auto legs = legs_to(door(false), {0.5, 2.0, 0.0}, kManner);
  REQUIRE(legs.size() == 2);
  check_at(legs[0], 2.0, 3.8);
  CHECK(legs[0].via);
  check_at(legs[1], 2.0, 4.5);
  CHECK_FALSE(legs[1].via);
  CHECK(legs[1].reach_radius == 0.3);
}

TEST_CASE("a robot that stands in front of the door already drives straight on", "[components][goto]") {
  CHECK(legs_to(door(true), {2.05, 4.0, 0.0}, kManner).size() == 1);
  CHECK(legs_to(door(true), {2.2, 4.0, 0.0}, kManner).size() == 2);
  CHECK(legs_to(door(true), {2.05, 3.5, 0.0}, kManner).size() == 2);
}

TEST_CASE("the places of a door stay while the robot passes through it, and those of another point are new",
          "[components][goto]") {
  Legs legs;
  const Route::Point first = door(true);
  check_at(legs.next(first, {2.0, 2.0, 0.0}, kManner), 2.0, 3.8);
  CHECK_FALSE(legs.at_last());
  legs.pop();
  check_at(legs.next(first, {2.0, 4.6, 0.0}, kManner), 2.0, 5.2);  // although it is on the other side now
  CHECK(legs.at_last());
  check_at(legs.next(place(1.0, 1.0), {2.0, 4.6, 0.0}, kManner), 1.0, 1.0);
  legs.pop();
  check_at(legs.next(first, {2.0, 6.0, 0.0}, kManner), 2.0, 5.2);
}
