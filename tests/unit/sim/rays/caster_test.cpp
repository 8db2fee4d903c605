// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/base/random.hpp"
#include "orca/sim/caster.hpp"
#include "slow_run.hpp"

using namespace orca::sim;
using orca::direction;
using orca::Pose2;
using orca::rotated;
using orca::Vec2;
using orca::sim::test::kPi;

namespace {

// The reference: in a frame whose x axis is the ray, an edge is met where its line crosses y = 0.
double brute_force(const WorldModel& world, const Ray& ray) {
  double best = ray.max_range;
  const double angle = std::atan2(ray.direction.y, ray.direction.x);
  const auto local = [&](Vec2 p) { return rotated(p - ray.origin, -angle); };
  const auto offer = [&](double t) { best = t >= 0.0 && t < best ? t : best; };
  for (const Obstacle& o : world.obstacles) {
    if (o.height <= ray.sensor_height) continue;
    for (const Segment& e : edges_of(o.shape)) {
      const Vec2 a = local(e.a);
      const Vec2 b = local(e.b);
      if ((a.y > 0.0) != (b.y > 0.0)) offer(a.x - a.y * (b.x - a.x) / (b.y - a.y));
    }
    if (const auto* c = std::get_if<Circle>(&o.shape)) {
      const Vec2 m = local(c->center);
      if (std::fabs(m.y) > c->radius) continue;
      const double half = std::sqrt((c->radius - m.y) * (c->radius + m.y));
      offer(m.x - half);
      if (m.x - half < 0.0) offer(m.x + half);
    }
  }
  return best;
}

WorldModel clutter(orca::RandomStream& random) {
  WorldModel world;
  world.obstacles.push_back({"south", Box{{15, -0.1, 0}, {15, 0.1}}, 2.5});
  world.obstacles.push_back({"north", Box{{15, 20.1, 0}, {15, 0.1}}, 2.5});
  for (int i = 0; i < 100; ++i) {
    const Pose2 pose{random.uniform(0, 30), random.uniform(0, 20), random.uniform(-kPi, kPi)};
    const Vec2 half{random.uniform(0.05, 0.8), random.uniform(0.05, 0.8)};
    world.obstacles.push_back({"box", Box{pose, half}, random.uniform(0.1, 1.0)});
    world.obstacles.push_back(
        {"post", Circle{{random.uniform(0, 30), random.uniform(0, 20)}, random.uniform(0.03, 0.4)}, 1.0});
  }
  return world;
}

// A closed room, 4 x 3 m inside, of four walls whose corners are shared points.
WorldModel room() {
  Outline inside = outline_of({{0, 0}, {4, 0}, {4, 3}, {0, 3}});
  for (Segment& e : inside.edges) e = {e.b, e.a};
  for (const Segment& e : outline_of({{-1, -1}, {5, -1}, {5, 4}, {-1, 4}}).edges) inside.edges.push_back(e);
  return {"room", {{"walls", inside, 2.5}}, {}};
}

double room_range(Vec2 p, double angle) {
  return Caster(room()).cast({p, direction(angle), 100.0, 0.0}).range;
}

}  // namespace

TEST_CASE("a cast equals the brute-force closed form on random rays within 1e-9 m", "[sim][caster]") {
  orca::RandomStream random(11, "test", "caster");
  const WorldModel world = clutter(random);
  const Caster caster(world);
  double worst = 0.0;
  for (int i = 0; i < orca::test::part_of(300'000); ++i) {
    const Ray ray{{random.uniform(-2, 32), random.uniform(-2, 22)},
                  direction(random.uniform(-kPi, kPi)),
                  random.uniform(0.0, 40.0),
                  random.uniform(0.0, 1.0)};
    const double error = std::fabs(caster.cast(ray).range - brute_force(world, ray));
    if (error > 1e-9) UNSCOPED_INFO("ray " << i << " off by " << error);
    worst = std::max(worst, error);
  }
  CHECK(worst <= 1e-9);
}

TEST_CASE("no ray leaves a closed room, wherever it starts and also through the corners", "[sim][caster]") {
  const Caster caster(room());
  orca::RandomStream random(12, "test", "room");
  for (int i = 0; i < orca::test::part_of(50'000); ++i) {
    Vec2 p{random.uniform(0, 4), random.uniform(0, 3)};
    if (i % 3 == 0) p.x = i % 2 == 0 ? 1e-10 : 4.0 - 1e-10;
    if (i % 5 == 0) p.y = i % 2 == 0 ? 0.0 : 3.0;
    const Vec2 corner{i % 4 < 2 ? 0.0 : 4.0, i % 2 == 0 ? 0.0 : 3.0};
    const double angle = i % 7 == 0 ? std::atan2(corner.y - p.y, corner.x - p.x) : random.uniform(-kPi, kPi);
    const Hit hit = caster.cast({p, direction(angle), 100.0, 0.0});
    const Vec2 end = p + hit.range * direction(angle);
    REQUIRE(hit.found());
    REQUIRE(end.x >= -1e-8);
    REQUIRE(end.x <= 4.0 + 1e-8);
    REQUIRE(end.y >= -1e-8);
    REQUIRE(end.y <= 3.0 + 1e-8);
  }
}

TEST_CASE("axis-parallel rays and rays into shared corners have their exact length", "[sim][caster]") {
  CHECK(room_range({1, 1}, 0.0) == Approx(3.0).margin(1e-12));
  CHECK(room_range({1, 1}, 0.5 * kPi) == Approx(2.0).margin(1e-12));
  CHECK(room_range({1, 1}, kPi) == Approx(1.0).margin(1e-12));
  CHECK(room_range({1, 1}, -0.5 * kPi) == Approx(1.0).margin(1e-12));
  CHECK(room_range({1, 0}, std::atan2(1.0, 1.0)) == Approx(0.0).margin(1e-9));
  CHECK(room_range({3, 2}, 0.25 * kPi) == Approx(std::sqrt(2.0)).margin(1e-9));
}

TEST_CASE("a ray that starts within a nanometre of a wall meets it and does not pass through",
          "[sim][caster]") {
  CHECK(room_range({4.0 + 5e-10, 1.0}, 0.0) <= 1e-9);
  CHECK(room_range({4.0 - 5e-10, 1.0}, 0.0) <= 1e-9);
  CHECK(room_range({-5e-10, 1.0}, kPi) <= 1e-9);
}

TEST_CASE("a ray along the shared line of two pixels' corners does not slip between them", "[sim][caster]") {
  // Two solids that touch in one point, as diagonal pixels do.
  Outline pixels = outline_of({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  for (const Segment& e : outline_of({{1, 1}, {2, 1}, {2, 2}, {1, 2}}).edges) pixels.edges.push_back(e);
  const Caster caster(WorldModel{"pixels", {{"map", pixels, 1.0}}, {}});
  const Hit hit = caster.cast({{0.0, 2.0}, direction(-0.25 * kPi), 10.0, 0.0});
  CHECK(hit.range == Approx(std::sqrt(2.0)).margin(1e-9));
}

TEST_CASE("incidence is the angle between ray and surface normal", "[sim][caster]") {
  const Caster caster(room());
  CHECK(caster.cast({{1, 1}, direction(0.3), 10.0, 0.0}).incidence() == Approx(0.3));
  CHECK(caster.cast({{1, 1}, direction(0.3), 10.0, 0.0}).steeper_than(std::tan(0.301)));
  CHECK_FALSE(caster.cast({{1, 1}, direction(0.3), 10.0, 0.0}).steeper_than(std::tan(0.299)));
  const Caster post(WorldModel{"post", {{"post", Circle{{2, 0}, 0.5}, 1.0}}, {}});
  CHECK(post.cast({{0, 0}, direction(0.0), 10.0, 0.0}).incidence() == Approx(0.0).margin(1e-9));
  CHECK(post.cast({{0, 0.25}, direction(0.0), 10.0, 0.0}).incidence() == Approx(std::asin(0.5)));
}

TEST_CASE("obstacles that are not taller than the sensor or lie beyond the range are not seen",
          "[sim][caster]") {
  const Caster caster(WorldModel{"desk", {{"desk", Box{{2, 0, 0}, {0.5, 0.5}}, 0.7}}, {}});
  CHECK(caster.cast({{0, 0}, {1, 0}, 10.0, 0.69}).range == 1.5);
  CHECK_FALSE(caster.cast({{0, 0}, {1, 0}, 10.0, 0.7}).found());
  const Hit none = caster.cast({{0, 0}, {1, 0}, 1.4, 0.0});
  CHECK_FALSE(none.found());
  CHECK(none.range == 1.4);
  CHECK_FALSE(Caster(WorldModel{}).cast({{0, 0}, {1, 0}, 5.0, 0.0}).found());
}

TEST_CASE("moving bodies are seen where they are, except the sensor's own", "[sim][caster]") {
  Caster caster(room());
  const auto own = caster.add_body({Circle{{1, 1}, 0.2}, 0.0, 0.4});
  const auto other = caster.add_body({Circle{{3, 1}, 0.2}, 0.0, 0.4});
  Ray ray{{1, 1}, {1, 0}, 10.0, 0.3, own};
  CHECK(caster.cast(ray).range == Approx(1.8));
  caster.move_body(other, Box{{3, 1, 0.25 * kPi}, {0.2, 0.2}});
  CHECK(caster.cast(ray).range == Approx(2.0 - 0.2 * std::sqrt(2.0)));
  ray.sensor_height = 0.5;
  CHECK(caster.cast(ray).range == Approx(3.0));
}
