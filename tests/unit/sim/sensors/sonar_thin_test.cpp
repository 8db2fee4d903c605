// SPDX-License-Identifier: GPL-3.0-or-later
// Things that stand between the rays of any fan, above or below a sonar, or in one line, without noise.
#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/base/random.hpp"
#include "sensors/sonar_beam.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using orca::direction;
using orca::Vec2;

namespace {

constexpr double kHalfOfLobe = 12.5 * kDegree;
constexpr double kSmooth = 25.0 * kDegree;  // [rad] The critical angle at nominal realism.
constexpr double kIdeal = 90.0 * kDegree;
constexpr double kAboveFloor = 0.3;

std::optional<double> heard(const WorldModel& world, double yaw, double critical = kSmooth) {
  const Caster caster(world);
  detail::Echo echo;
  const detail::Beam beam({0, 0, yaw}, detail::Lobe(kHalfOfLobe), 0.15, 6.5, kAboveFloor,
                          static_cast<std::size_t>(-1));
  detail::listen_for(caster, beam, std::tan(critical), echo);
  return echo.range;
}

// Checks that what stands ahead is heard at `range` wherever the lobe holds it, and not beyond its rims. `wide` is half
// the angle that it fills.
void check_whole_lobe(const WorldModel& world, double range, double wide) {
  for (int i = -1000; i <= 1000; ++i) {
    const double yaw = i * 1e-3 * (kHalfOfLobe - 1e-9);
    const auto echo = heard(world, yaw);
    CAPTURE(yaw);
    REQUIRE(echo);
    REQUIRE(*echo == Approx(range).margin(1e-9));
  }
  for (const double side : {-1.0, 1.0}) CHECK_FALSE(heard(world, side * (kHalfOfLobe + wide + 1e-6)));
}

// A wall from one point to another, 0.1 m thick, with its face on the line between them and its body to the left.
Obstacle wall(Vec2 from, Vec2 to, double bottom = 0.0, double top = 2.5) {
  const Vec2 along = to - from;
  const double yaw = std::atan2(along.y, along.x);
  const Vec2 middle = 0.5 * (from + to) + 0.05 * direction(yaw + 0.5 * kPi);
  return {"wall", Box{{middle.x, middle.y, yaw}, {0.5 * norm(along), 0.05}}, top, bottom};
}

// A face across the beam from `bottom` to `top` [m].
WorldModel across(double distance, double bottom, double top) {
  return {"across", {wall({distance, 2.0}, {distance, -2.0}, bottom, top)}, {}};
}

// A wall through a point, which the beam meets at 50 deg and mirrors. It is longer than the lobe is wide.
Obstacle mirror(double distance, double bottom = 0.0, double top = 2.5) {
  const Vec2 along = 2.0 * direction(40.0 * kDegree);
  return wall(Vec2{distance, 0} + along, Vec2{distance, 0} - along, bottom, top);
}

// Two walls in one line, which meet at (2, 0). The beam meets both at about 50 deg.
WorldModel slanted_pair(double gap, double step = 0.0, double turn = 0.0) {
  const Vec2 along = direction(40.0 * kDegree);
  const Vec2 aside = step * direction(130.0 * kDegree);
  const Vec2 meet{2.0, 0.0};
  return {"pair",
          {wall(meet + 3.0 * along, meet + 0.5 * gap * along),
           wall(meet - 0.5 * gap * along + aside, meet - 3.0 * direction(40.0 * kDegree + turn) + aside)},
          {}};
}

}  // namespace

TEST_CASE("a chair leg of 2 cm is heard in the whole lobe, at every distance", "[sim][sonar][validation]") {
  for (const double distance : {0.3, 1.0, 2.5, 6.0}) {
    CAPTURE(distance);
    check_whole_lobe({"leg", {{"leg", Circle{{distance, 0}, 0.01}, 0.75}}, {}}, distance - 0.01,
                     std::asin(0.01 / distance));
  }
}

TEST_CASE("a post of a BARN world is heard in the whole lobe at 5 m", "[sim][sonar][validation]") {
  check_whole_lobe({"post", {{"post", Circle{{5.0, 0}, 0.075}, 1.0}}, {}}, 5.0 - 0.075,
                   std::asin(0.075 / 5.0));
}

TEST_CASE("a board of 2 cm that stands edge-on is heard in the whole lobe", "[sim][sonar][validation]") {
  for (const double distance : {0.5, 2.0, 5.0}) {
    CAPTURE(distance);
    check_whole_lobe({"board", {{"board", Box{{distance + 0.5, 0, 0}, {0.5, 0.01}}, 2.5}}, {}}, distance,
                     std::atan(0.01 / distance));
  }
}

TEST_CASE("what stands behind a mirroring wall is not heard through it", "[sim][sonar][validation]") {
  const Obstacle post{"post", Circle{{2.5, 0.0}, 0.05}, 1.0};
  CHECK(heard({"post", {post}, {}}, 0.0));
  CHECK_FALSE(heard({"both", {mirror(1.2), post}, {}}, 0.0));
}

TEST_CASE("a kerb is heard from where the cone has opened down to it", "[sim][sonar][validation]") {
  // The cone reaches down to 0.1 m above the floor at (0.3 m - 0.1 m) / tan(12.5 deg) = 0.902 m.
  const double opens = 0.2 / std::tan(kHalfOfLobe);
  CHECK_FALSE(heard(across(opens * std::cos(kHalfOfLobe) - 1e-6, 0.0, 0.1), 0.0));
  for (const double distance : {opens - 0.01, opens + 0.01, 1.5, 4.0}) {
    CAPTURE(distance);
    const double exact = std::hypot(std::max(distance, opens), 0.2);
    CHECK(heard(across(distance, 0.0, 0.1), 0.0).value() == Approx(exact).margin(1e-9));
  }
}

TEST_CASE("a table top is heard from where the cone has opened up to it", "[sim][sonar][validation]") {
  const double opens = 0.4 / std::tan(kHalfOfLobe);
  CHECK_FALSE(heard(across(opens * std::cos(kHalfOfLobe) - 1e-6, 0.7, 0.74), 0.0));
  for (const double distance : {opens - 0.01, opens + 0.01, 3.0, 6.0}) {
    CAPTURE(distance);
    const double exact = std::hypot(std::max(distance, opens), 0.4);
    CHECK(heard(across(distance, 0.7, 0.74), 0.0).value() == Approx(exact).margin(1e-9));
  }
  const WorldModel round{"round", {{"table", Circle{{3.0, 0.0}, 0.5}, 0.74, 0.7}}, {}};
  CHECK(heard(round, 0.0).value() == Approx(std::hypot(2.5, 0.4)).margin(1e-9));
}

TEST_CASE("a sonar below a table hears neither its top nor the far end of it", "[sim][sonar][validation]") {
  const WorldModel world{"table", {{"table", Box{{1.0, 0, 0}, {2.0, 0.6}}, 0.74, 0.7}}, {}};
  for (const double critical : {kSmooth, kIdeal}) CHECK_FALSE(heard(world, 0.0, critical));
}

TEST_CASE("a kerb is hidden by what stands before it at heights between its own and the sonar's",
          "[sim][sonar][validation]") {
  const auto heard_behind = [](double bottom, double top) {
    WorldModel world = across(3.0, 0.0, 0.1);
    world.obstacles.push_back(mirror(1.8, bottom, top));
    return heard(world, 0.0);
  };
  CHECK(heard_behind(0.0, 0.05).value() == Approx(std::hypot(3.0, 0.2)).margin(1e-9));
  CHECK(heard_behind(0.6, 0.8).value() == Approx(std::hypot(3.0, 0.2)).margin(1e-9));
  CHECK_FALSE(heard_behind(0.0, 0.2));
  CHECK_FALSE(heard_behind(0.0, 2.5));
}

TEST_CASE("where two walls meet in one line there is no edge", "[sim][sonar][validation]") {
  CHECK_FALSE(heard(slanted_pair(0.0), 0.0));
  CHECK_FALSE(heard(slanted_pair(-0.1), 0.0));  // They overlap.
  CHECK_FALSE(heard(slanted_pair(0.0, 0.0, 0.5 * kDegree), 0.0));
  CHECK(heard(slanted_pair(-0.1, 0.02), 0.0));
  CHECK(heard(slanted_pair(0.0, 0.0, 10.0 * kDegree), 0.0).value() == Approx(2.0).margin(1e-9));
  const double nearer_end = norm(Vec2{2, 0} - 0.1 * direction(40.0 * kDegree));
  CHECK(heard(slanted_pair(0.2), 0.0).value() == Approx(nearer_end).margin(1e-9));
}

TEST_CASE("the end of an edge is no part of a wall, however its coordinates round",
          "[sim][sonar][validation]") {
  // A wedge turns its point to the sonar. It is 11 deg off the axis, where edges are too weak to be heard.
  orca::RandomStream random(1, "test", "ends");
  constexpr double kBearing = 11.0 * kDegree;
  for (int i = 0; i < 400; ++i) {
    const Vec2 point = random.uniform(0.5, 5.0) * direction(kBearing);
    const double length = random.uniform(1.0, 2.0);
    const WorldModel wedge{"wedge",
                           {{"wedge",
                             outline_of({point, point + length * direction(kBearing + 20.0 * kDegree),
                                         point + length * direction(kBearing + 50.0 * kDegree)}),
                             2.5}},
                           {}};
    CAPTURE(i);
    REQUIRE_FALSE(heard(wedge, 0.0));
    REQUIRE(heard(wedge, 4.0 * kDegree).value() == Approx(norm(point)).margin(1e-9));
  }
}

TEST_CASE("a lobe of a right angle to each side hears what is beside the sonar", "[sim][sonar][validation]") {
  const detail::Lobe wide(90.0 * kDegree);
  for (const double angle : {-89.0, -45.0, 0.0, 70.0, 89.0}) {
    const Caster caster({"leg", {{"leg", Circle{2.0 * direction(angle * kDegree), 0.01}, 0.75}}, {}});
    detail::Echo echo;
    detail::listen_for(caster, {{}, wide, 0.15, 6.5, kAboveFloor, static_cast<std::size_t>(-1)},
                       std::tan(kSmooth), echo);
    CAPTURE(angle);
    CHECK(echo.range.value() == Approx(1.99).margin(1e-9));
  }
}
