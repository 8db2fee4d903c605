// SPDX-License-Identifier: GPL-3.0-or-later
// The echoes that a transducer hears from corners and smooth walls, without noise, against closed forms.
#include <catch2/catch.hpp>

#include "scout.hpp"
#include "sensors/sonar_beam.hpp"

using namespace orca::sim;
using orca::direction;
using orca::Pose2;
using orca::Vec2;
using namespace orca::sim::test;

namespace {

constexpr double kCritical = 25.0 * kDegree;
constexpr double kHalfLobe = 12.5 * kDegree;

detail::Beam lone_beam_at(const Pose2& sensor) {
  return {sensor, detail::Lobe(kHalfLobe), 0.15, 6.5, 0.3, static_cast<std::size_t>(-1)};
}

std::optional<double> heard(const WorldModel& world, const Pose2& sensor) {
  const Caster caster(world);
  detail::Echo echo;
  detail::listen_for(caster, lone_beam_at(sensor), std::tan(kCritical), echo);
  return echo.range;
}

// A wall through `foot`, whose normal looks at the angle `normal`; 20 m long.
Obstacle wall(Vec2 foot, double normal) {
  const Vec2 middle = foot - 0.1 * direction(normal);
  return {"wall", Box{{middle.x, middle.y, normal}, {0.1, 10}}, 2.5};
}

}  // namespace

TEST_CASE("a corner reads as its distance at every angle until a wall is met below the critical one",
          "[sim][sonar][validation]") {
  // Two walls meet at (0, 0); the sensor turns about a place on their bisector.
  const WorldModel corner{
      "corner", {wall({0, 0}, std::numbers::pi), wall({0, 0}, -0.5 * std::numbers::pi)}, {}};
  const Vec2 at = 2.0 * direction(-135.0 * kDegree);
  // Off the bisector by 7.5 deg the rim of the lobe meets a wall at 45 - 7.5 - 12.5 = 25 deg.
  for (int degrees = -7; degrees <= 7; ++degrees) {
    CAPTURE(degrees);
    const auto range = heard(corner, {at.x, at.y, (45.0 + degrees) * kDegree});
    REQUIRE(range);
    CHECK(*range == Approx(2.0).margin(1e-9));
  }
  CHECK(heard(corner, {at.x, at.y, 53.0 * kDegree}).value() < 1.9);
}

TEST_CASE("a wall reads as its perpendicular at every angle within the lobe", "[sim][sonar][validation]") {
  const WorldModel flat{"flat", {wall({2, 0}, std::numbers::pi)}, {}};
  for (int degrees = -12; degrees <= 12; ++degrees) {
    CAPTURE(degrees);
    const auto range = heard(flat, {0, 0, degrees * kDegree});
    REQUIRE(range);
    CHECK(*range == Approx(2.0).margin(1e-9));
  }
}

TEST_CASE("a smooth wall at forty degrees is not heard", "[sim][sonar][validation]") {
  const WorldModel slanted{"slanted", {wall({2, 0}, 140.0 * kDegree)}, {}};
  CHECK_FALSE(heard(slanted, {0, 0, 0}));
}

TEST_CASE("behind a smooth wall at forty degrees the second bounce is heard at the length of the whole way",
          "[sim][sonar][validation]") {
  // The beam meets the first wall after 2 m and is mirrored by twice 40 deg; the second wall stands across
  // it.
  const double away = 100.0 * kDegree;
  for (const double further : {0.5, 1.5, 3.0}) {
    const Vec2 foot = Vec2{2, 0} + further * direction(away);
    const WorldModel two{"two", {wall({2, 0}, 140.0 * kDegree), wall(foot, away + std::numbers::pi)}, {}};
    const auto range = heard(two, {0, 0, 0});
    CAPTURE(further);
    REQUIRE(range);
    // Nine rays find the perpendicular within 1.6 degrees.
    CHECK(*range == Approx(2.0 + further).epsilon(0.001));
  }
}

TEST_CASE("a second bounce beyond the ring's range is not heard", "[sim][sonar][validation]") {
  const double away = 100.0 * kDegree;
  const Vec2 foot = Vec2{2, 0} + 4.6 * direction(away);
  const WorldModel two{"two", {wall({2, 0}, 140.0 * kDegree), wall(foot, away + std::numbers::pi)}, {}};
  CHECK_FALSE(heard(two, {0, 0, 0}));
}
