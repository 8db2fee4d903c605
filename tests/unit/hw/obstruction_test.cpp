// SPDX-License-Identifier: GPL-3.0-or-later
// A base that has met something stands until a command asks for another direction.
#include <catch2/catch.hpp>

#include "orca/hw/endpoints.hpp"

using namespace orca;
using namespace orca::hw;
using Catch::Contains;

namespace {

constexpr TimePoint kNow{1000s};
constexpr DriveSetpoint kStandstill{.at_once = true};

struct ObstructedBase {
  MotionHW motion{{.max_speed = 1.0, .max_turn_rate = 2.0, .type = idl::HOLONOMIC}, 200ms};

  Status drive(double forward, double turn_rate = 0.0, double left = 0.0) {
    auto velocity = make_object<idl::HolonomicVelocity>();
    velocity->speed(forward);
    velocity->left(left);
    velocity->turn_rate(turn_rate);
    return motion.command(*velocity, kNow);
  }
  [[nodiscard]] bool stands() { return motion.due(kNow) == kStandstill; }
};

const std::vector<Obstruction::Pressed> kFrontPressed{{{1.0, 0.0}, "front"}};

}  // namespace

TEST_CASE("a base that meets something stands at once, and refuses to go on with the reason",
          "[hw][obstruction]") {
  ObstructedBase base;
  REQUIRE(base.drive(0.5, 0.1).ok());
  base.motion.obstruct("it touched a wall");
  CHECK(base.stands());
  for (const double turn_rate : {0.0, 0.5, -0.5}) {
    const Status refused = base.drive(0.2, turn_rate);
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == Code::unavailable);
    CHECK_THAT(refused.error().text(), Contains("it touched a wall"));
    CHECK(base.stands());
  }
}

TEST_CASE("a command in another direction frees the base, and then it may go anywhere", "[hw][obstruction]") {
  struct Way {
    double forward, turn_rate, left;
  };
  for (const Way& way : {Way{-0.2, 0.0, 0.0}, Way{0.0, 0.5, 0.0}, Way{0.0, 0.0, 0.3}, Way{-0.1, 1.0, 0.1}}) {
    ObstructedBase base;
    REQUIRE(base.drive(0.5).ok());
    base.motion.obstruct("it touched a wall");
    CHECK(base.drive(way.forward, way.turn_rate, way.left).ok());
    CHECK_FALSE(base.stands());
    CHECK(base.drive(0.5).ok());
    CHECK_FALSE(base.stands());
  }
}

TEST_CASE("a stop is no other direction", "[hw][obstruction]") {
  ObstructedBase base;
  REQUIRE(base.drive(0.5).ok());
  base.motion.obstruct("it touched a wall");
  CHECK(base.drive(0.0).ok());
  CHECK_FALSE(base.drive(0.5).ok());
}

TEST_CASE("a base that is stalled while it turns on the spot may turn the other way, or drive",
          "[hw][obstruction]") {
  ObstructedBase base;
  REQUIRE(base.drive(0.0, 0.5).ok());
  base.motion.obstruct("its motors are stalled");
  CHECK_FALSE(base.drive(0.0, 0.2).ok());
  CHECK(base.drive(0.0, -0.2).ok());
  CHECK(base.drive(0.0, 0.2).ok());
  base.motion.obstruct("its motors are stalled");
  CHECK(base.drive(-0.15, 0.1).ok());
}

TEST_CASE("what comes to a standing base obstructs nothing", "[hw][obstruction]") {
  ObstructedBase base;
  base.motion.obstruct("a person touched it");
  CHECK(base.drive(0.5).ok());
}

TEST_CASE(
    "a base is hindered by what it has met until it moves another way, by a bumper while that is pressed",
    "[hw][obstruction]") {
  ObstructedBase base;
  REQUIRE(base.drive(0.5).ok());
  CHECK_FALSE(base.motion.take_hindrance(Hindrance::touch));
  base.motion.obstruct("its motors are stalled", Hindrance::stall);
  CHECK(base.motion.take_hindrance(Hindrance::stall) == "its motors are stalled");
  CHECK(base.motion.take_hindrance(Hindrance::stall));
  CHECK_FALSE(base.motion.take_hindrance(Hindrance::touch));
  REQUIRE(base.drive(-0.2).ok());
  CHECK_FALSE(base.motion.take_hindrance(Hindrance::stall));

  base.motion.press(kFrontPressed);
  CHECK(base.motion.take_hindrance(Hindrance::touch));
  base.motion.press({});
  CHECK_FALSE(base.motion.take_hindrance(Hindrance::touch));
}

TEST_CASE("a touch that is over before anybody asks is reported once", "[hw][obstruction]") {
  ObstructedBase base;
  REQUIRE(base.drive(0.5).ok());
  base.motion.press(kFrontPressed);
  base.motion.press({});
  REQUIRE(base.drive(-0.2).ok());
  CHECK(base.motion.take_hindrance(Hindrance::touch));
  CHECK_FALSE(base.motion.take_hindrance(Hindrance::touch));
}

TEST_CASE("a pressed bumper stops a base that drives towards it, and only that", "[hw][obstruction]") {
  ObstructedBase base;
  REQUIRE(base.drive(-0.5).ok());
  base.motion.press(kFrontPressed);
  CHECK_FALSE(base.stands());
  base.motion.press({});
  REQUIRE(base.drive(0.5).ok());
  base.motion.press(kFrontPressed);
  CHECK(base.stands());
}

TEST_CASE("while a bumper is pressed nothing moves the base towards it, after that any command does",
          "[hw][obstruction]") {
  ObstructedBase base;
  base.motion.press(kFrontPressed);
  CHECK_THAT(base.drive(0.3).error().text(), Contains("\"front\" is pressed"));
  CHECK(base.drive(0.0, 0.5).ok());
  CHECK_FALSE(base.drive(0.1, 0.5).ok());
  CHECK(base.drive(-0.3).ok());
  base.motion.press({});
  CHECK(base.drive(0.3).ok());
}

TEST_CASE("a bumper that was pressed for a moment holds the base until a command asks for another direction",
          "[hw][obstruction]") {
  ObstructedBase base;
  REQUIRE(base.drive(0.5).ok());
  base.motion.press(kFrontPressed);
  base.motion.press({});
  CHECK_FALSE(base.drive(0.5).ok());
  CHECK(base.drive(0.0, 0.5).ok());
  CHECK(base.drive(0.5).ok());
}
