// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/footprint.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "orca/base/random.hpp"

using namespace orca::nav;
using orca::Vec2;

namespace {

constexpr Footprint kBody{0.25, 0.2, 0.33};

// Returns the distance from a point outside of the body to its outline, found by walking round it.
double distance_walked(Vec2 point) {
  double least = 1e9;
  for (int i = 0; i <= 1000; ++i) {
    const double along = -1.0 + 0.002 * i;
    for (const double side : {-1.0, 1.0}) {
      least = std::min(least, norm(point - Vec2{along * kBody.half_length, side * kBody.half_width}));
      least = std::min(least, norm(point - Vec2{side * kBody.half_length, along * kBody.half_width}));
    }
  }
  return least;
}

}  // namespace

TEST_CASE("the clearance of a rectangle is the distance to its outline, and not positive within",
          "[navigation]") {
  orca::RandomStream random(1, "test", "points");
  for (int i = 0; i < 500; ++i) {
    const Vec2 point{random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6)};
    const bool within = std::abs(point.x) <= kBody.half_length && std::abs(point.y) <= kBody.half_width;
    CAPTURE(point.x, point.y);
    CHECK(std::abs(std::abs(clearance(kBody, point)) - distance_walked(point)) < 0.001);
    CHECK((clearance(kBody, point) <= 0.0) == within);
  }
}

TEST_CASE("the circle that holds a robot cuts the corners of the rectangle that holds it", "[navigation]") {
  constexpr Footprint kCut{0.3, 0.2, 0.31};
  CHECK(kCut.outer_radius() == 0.31);
  CHECK(kCut.inner_radius() == 0.2);
  CHECK(std::abs(clearance(kCut, Vec2{0.35, 0.0}) - 0.05) < 1e-12);
  CHECK(std::abs(clearance(kCut, Vec2{0.0, 0.25}) - 0.05) < 1e-12);
  const Vec2 corner{0.3, 0.2};
  CHECK(std::abs(clearance(kCut, corner) - (norm(corner) - 0.31)) < 1e-12);
  const std::array beside{Vec2{0.0, 0.33}};
  CHECK(room_along(kCut, {}, {0.0, 0.0, 3.0}, 30, beside, 0.01).share == 1.0);
  CHECK(room_along({0.3, 0.2, 0.0}, {}, {0.0, 0.0, 3.0}, 30, beside, 0.01).share < 0.5);
}

TEST_CASE("a robot beside something may drive along it, and comes no nearer step by step", "[navigation]") {
  const std::array wall{Vec2{0.1, 0.21}, Vec2{0.3, 0.21}, Vec2{0.5, 0.21}, Vec2{0.7, 0.21}};
  constexpr double kMargin = 0.02;
  CHECK(room_along(kBody, {}, {0.4, 0.0, 0.0}, 8, wall, kMargin).share == 1.0);
  for (const double skew : {0.02, 0.05})
    CHECK(room_along(kBody, {0.0, 0.0, skew}, {0.4, 0.0, 0.0}, 80, wall, kMargin).share < 1.0);
}

TEST_CASE("a robot that has left one thing comes no nearer to another than it may", "[navigation]") {
  const std::array things{Vec2{-0.253, 0.0}, Vec2{0.7, 0.0}};
  const Room room = room_along(kBody, {}, {0.6, 0.0, 0.0}, 60, things, 0.03);
  CHECK(room.share * 0.6 > 0.40);
  CHECK(room.share * 0.6 < 0.43);
}

TEST_CASE("a robot without length and width is a circle", "[navigation]") {
  constexpr Footprint kRound{0.0, 0.0, 0.3};
  CHECK(kRound.inner_radius() == 0.3);
  CHECK(kRound.outer_radius() == 0.3);
  CHECK(std::abs(clearance(kRound, Vec2{0.3, 0.4}) - 0.2) < 1e-12);
}

TEST_CASE("the clearance does not depend on where robot and obstacles are together", "[navigation]") {
  orca::RandomStream random(2, "test", "places");
  for (int i = 0; i < 300; ++i) {
    const orca::Pose2 pose{random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0), random.uniform(-3.0, 3.0)};
    const std::array there{Vec2{random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7)}};
    const std::array seen{pose * there[0]};
    CHECK(std::abs(clearance(kBody, pose, seen, 1.0) - clearance(kBody, there[0])) < 1e-9);
  }
}

TEST_CASE("a straight drive is free up to the margin before what stands ahead", "[navigation]") {
  const std::array ahead{Vec2{1.0, 0.1}};
  const Room room = room_along(kBody, {}, {2.0, 0.0, 0.0}, 200, ahead, 0.05);
  CHECK(std::abs(2.0 * room.share - (1.0 - 0.25 - 0.05)) < 0.011);
  CHECK(room.clearance >= 0.05);
  const std::array beside{Vec2{1.0, 0.3}};
  CHECK(room_along(kBody, {}, {2.0, 0.0, 0.0}, 200, beside, 0.05).share == 1.0);
  CHECK(std::abs(room_along(kBody, {}, {2.0, 0.0, 0.0}, 200, beside, 0.05).clearance - 0.1) < 1e-9);
}

TEST_CASE("a robot that is too near to something may move away from it, but not nearer", "[navigation]") {
  const std::array ahead{Vec2{0.26, 0.0}};
  CHECK(room_along(kBody, {}, {-0.3, 0.0, 0.0}, 30, ahead, 0.05).share == 1.0);
  CHECK(room_along(kBody, {}, {0.3, 0.0, 0.0}, 30, ahead, 0.05).share == 0.0);
}

TEST_CASE(
    "a corner that sweeps over an obstacle is seen: a rectangle turns where its circle would, not its width",
    "[navigation]") {
  const std::array beside{Vec2{0.0, 0.3}};  // farther away than half the length, nearer than the corners
  constexpr double kQuarter = std::numbers::pi / 2;
  CHECK(room_along(kBody, {}, {0.0, 0.0, kQuarter}, 90, beside, 0.0).share < 1.0);
  const std::array far{Vec2{0.0, 0.33}};
  CHECK(room_along(kBody, {}, {0.0, 0.0, kQuarter}, 90, far, 0.0).share == 1.0);
}
