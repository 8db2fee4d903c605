// SPDX-License-Identifier: GPL-3.0-or-later
// Khatib's field, what it can and what it is known not to.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/vec2.hpp"
#include "potential_field/force.hpp"

using namespace orca::field;
using orca::Vec2;

namespace {

constexpr Settings kField{.attraction = 1.0,
                          .repulsion = 0.001,
                          .influence = 0.6,
                          .damping = 1.0,
                          .max_speed = 0.4,
                          .body = {.radius = 0.3}};

// Returns the potential of an echo, of which the repulsion is the gradient: eta / 2 (1 / rho - 1 / rho_0)^2.
double potential(Vec2 robot, Vec2 echo) {
  const double rho = norm(echo - robot) - kField.body.radius;
  const double term = std::max(0.0, 1.0 / rho - 1.0 / kField.influence);
  return 0.5 * kField.repulsion * term * term;
}

struct Journey {
  double left = 0.0;  // [m] to the goal in the end.
  double clearance = std::numeric_limits<double>::infinity();
};

// Lets a point that can move in any direction follow the field, from the origin.
Journey follow(const std::vector<Vec2>& places, Vec2 goal, double seconds) {
  constexpr double kLap = 0.02;
  Vec2 robot;
  Journey journey;
  for (double time = 0.0; time < seconds; time += kLap) {
    std::vector<Vec2> echoes;
    for (const Vec2 place : places) echoes.push_back(place - robot);
    const Vec2 force = attraction(goal - robot, kField) + repulsion(echoes, kField);
    robot = robot + kLap * shortened(velocity(force, kField), kField.max_speed);
    for (const Vec2 place : places)
      journey.clearance = std::min(journey.clearance, norm(place - robot) - kField.body.radius);
  }
  journey.left = norm(goal - robot);
  return journey;
}

void add_line(std::vector<Vec2>& places, Vec2 from, Vec2 to) {
  const double length = norm(to - from);
  for (double along = 0.0; along <= length; along += 0.05)
    places.push_back(from + (along / length) * (to - from));
}

// Open towards the origin.
std::vector<Vec2> u_trap() {
  std::vector<Vec2> places;
  add_line(places, {1.5, 0.8}, {3.0, 0.8});
  add_line(places, {3.0, 0.8}, {3.0, -0.8});
  add_line(places, {3.0, -0.8}, {1.5, -0.8});
  return places;
}

}  // namespace

TEST_CASE("the attraction is in proportion to the way to the goal until it would exceed the greatest speed",
          "[field]") {
  CHECK(attraction({0.2, 0.1}, kField) == Vec2{0.2, 0.1});
  CHECK(norm(velocity(attraction({3.0, 4.0}, kField), kField)) == Approx(kField.max_speed));
}

TEST_CASE("the repulsion is the gradient of Khatib's potential", "[field]") {
  orca::RandomStream random(1, "test", "field");
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 200; ++i) {
    const Vec2 echo = random.uniform(0.35, 1.1) * orca::direction(random.uniform(-3.1, 3.1));
    const Vec2 force = repulsion(echo, kField);
    const double by_x = (potential({kStep, 0.0}, echo) - potential({-kStep, 0.0}, echo)) / (2 * kStep);
    const double by_y = (potential({0.0, kStep}, echo) - potential({0.0, -kStep}, echo)) / (2 * kStep);
    CHECK(force.x == Approx(-by_x).epsilon(1e-3).margin(1e-6));
    CHECK(force.y == Approx(-by_y).epsilon(1e-3).margin(1e-6));
  }
}

TEST_CASE("an echo repels from the nearest point of the body, within its influence only", "[field]") {
  Settings box = kField;
  box.body = {.half_length = 0.3, .half_width = 0.2, .radius = 0.35};
  CHECK(repulsion(Vec2{0.5, 0.0}, box) == repulsion(Vec2{0.5, 0.15}, box));
  CHECK(repulsion(Vec2{0.5, 0.0}, box).x < 0.0);
  CHECK(repulsion(Vec2{0.0, 0.4}, box).y == Approx(repulsion(Vec2{0.5, 0.0}, box).x));
  CHECK(repulsion(Vec2{0.91, 0.0}, box) == Vec2{});
  CHECK(std::isfinite(repulsion(Vec2{0.0, 0.1}, box).y));
  CHECK(repulsion(Vec2{0.0, 0.1}, box).y < 0.0);
}

TEST_CASE("a robot that cannot move sideways drives the part of the velocity that lies ahead", "[field]") {
  CHECK(course({0.3, 0.0}, kField).speed == Approx(0.3));
  CHECK(course({0.9, 0.0}, kField).speed == Approx(0.4));
  CHECK(course({0.3, 0.3}, kField).speed == Approx(0.3));
  CHECK(course({0.3, 0.3}, kField).direction == Approx(0.785398));
  CHECK(course({-0.3, 0.1}, kField).speed == 0.0);
}

TEST_CASE("in the open and past a post beside the way the field leads to the goal", "[field]") {
  CHECK(follow({}, {4.0, 1.0}, 40.0).left < 0.01);
  const Journey past = follow({{2.0, 0.2}}, {4.0, 0.0}, 60.0);
  CHECK(past.left < 0.01);
  CHECK(past.clearance > 0.05);
}

TEST_CASE("in a U the field has a local minimum before the goal, where the robot stays", "[field]") {
  const Journey one_minute = follow(u_trap(), {5.0, 0.1}, 60.0);
  const Journey ten_minutes = follow(u_trap(), {5.0, 0.1}, 600.0);
  CHECK(one_minute.left > 2.0);
  CHECK(ten_minutes.left == Approx(one_minute.left).margin(0.02));
  CHECK(ten_minutes.clearance > 0.05);
}

TEST_CASE("between two posts that the robot fits between the field may not let it through", "[field]") {
  const std::vector<Vec2> gate{{2.0, 0.35}, {2.0, -0.35}};
  CHECK(follow(gate, {4.0, 0.0}, 120.0).left > 2.0);
  const std::vector<Vec2> wide{{2.0, 0.7}, {2.0, -0.7}};
  CHECK(follow(wide, {4.0, 0.0}, 60.0).left < 0.01);
}
