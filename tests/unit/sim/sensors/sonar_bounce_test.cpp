// SPDX-License-Identifier: GPL-3.0-or-later
// How well nine rays find the second bounce, against 2,001 rays in the shipped office.
#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/base/random.hpp"
#include "rays/bearing.hpp"
#include "sensors/sonar_beam.hpp"
#include "shipped.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using orca::Pose2;
using orca::Vec2;

namespace {

const detail::Lobe kBounceLobe(12.5 * kDegree);
const double kSmoothTangent = std::tan(25.0 * kDegree);
constexpr double kFarthestBounce = 6.5;
constexpr double kBounceHeight = 0.3;

// Returns the way of a ray that a flat wall mirrors to something that sends it back.
std::optional<double> mirrored(const Caster& caster, const Ray& ray) {
  const Hit wall = caster.cast(ray);
  const auto* const face = std::get_if<Segment>(&wall.surface);
  if (face == nullptr) return std::nullopt;
  const Vec2 along = (1.0 / norm(face->b - face->a)) * (face->b - face->a);
  Ray second = ray;
  second.origin = wall.point - 1e-6 * ray.direction;
  second.direction = 2.0 * dot(ray.direction, along) * along - ray.direction;
  second.max_range -= wall.range;
  const Hit hit = caster.cast(second);
  if (!hit.found() || !hit.steeper_than(kSmoothTangent)) return std::nullopt;
  return wall.range + hit.range;
}

// Returns the nearest second bounce that evenly spread rays find.
std::optional<double> nearest_bounce(const Caster& caster, const Pose2& sensor, int rays) {
  const double rim = detail::bearing_of(kBounceLobe.rim);
  std::optional<double> nearest;
  for (int i = 0; i < rays; ++i) {
    const Vec2 u = detail::towards(rim * (2.0 * i / (rays - 1) - 1.0));
    const auto range =
        mirrored(caster, {sensor.position(), rotated((1.0 / norm(u)) * u, orca::direction(sensor.yaw)),
                          kFarthestBounce, kBounceHeight});
    if (range && (!nearest || *range < *nearest)) nearest = range;
  }
  return nearest;
}

bool are_equal(const std::optional<double>& a, const std::optional<double>& b, double margin) {
  return a.has_value() == b.has_value() && (!a || std::fabs(*a - *b) <= margin);
}

struct Bounces {
  int poses = 0, bounces = 0, missed = 0, off = 0;
  double farthest = 0.0;  // [m] Largest difference where both hear something.
};

void count_bounce(const Caster& caster, const Pose2& pose, detail::Echo& echo, Bounces& count) {
  detail::listen_for(caster,
                     {pose, kBounceLobe, 0.15, kFarthestBounce, kBounceHeight, static_cast<std::size_t>(-1)},
                     kSmoothTangent, echo);
  ++count.poses;
  // Where the echo is another one than that of nine rays, it is no second bounce.
  if (!are_equal(echo.range, nearest_bounce(caster, pose, 9), 1e-6)) return;
  const std::optional<double> exact = nearest_bounce(caster, pose, 2001);
  count.bounces += exact ? 1 : 0;
  count.missed += exact && !echo.range ? 1 : 0;
  if (!exact || !echo.range) return;
  count.off += are_equal(echo.range, exact, 0.01) ? 0 : 1;
  count.farthest = std::max(count.farthest, std::fabs(*echo.range - *exact));
}

}  // namespace

TEST_CASE("in 20,000 random poses in the office nine rays read 1 in 88 otherwise than 2,001 rays",
          "[sim][sonar][validation]") {
  const WorldModel office = shipped_world("office");
  const Caster caster(office);
  orca::RandomStream random(1, "test", "bounces");
  detail::Echo echo;
  Bounces count;
  while (count.poses < 20'000) {
    const Pose2 pose{random.uniform(0.0, 18.0), random.uniform(0.0, 12.0), random.uniform(-kPi, kPi)};
    if (office.obstacle_at(Circle{pose.position(), 0.2}, 0.0, 0.5) == nullptr)
      count_bounce(caster, pose, echo, count);
  }
  CAPTURE(count.bounces, count.missed, count.off, count.farthest);
  // docs/simulated-devices.md tells these numbers.
  CHECK(count.bounces == 1079);
  CHECK(count.missed == 80);
  CHECK(count.off == 146);
}
