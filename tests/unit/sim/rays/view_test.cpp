// SPDX-License-Identifier: GPL-3.0-or-later
// The guarantee of a view: every ray that it allows has the same hit as a ray cast by itself.
#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/base/random.hpp"
#include "orca/sim/caster.hpp"

using namespace orca::sim;
using orca::direction;
using orca::Pose2;
using orca::RandomStream;
using orca::rotated;
using orca::Vec2;
using orca::sim::test::kPi;

namespace {

Shape random_shape(RandomStream& random, Vec2 middle) {
  const Pose2 pose{middle.x + random.uniform(-6, 6), middle.y + random.uniform(-6, 6),
                   random.uniform(-kPi, kPi)};
  if (random.chance(0.5)) return Circle{pose.position(), random.uniform(0.05, 0.6)};
  return Box{pose, {random.uniform(0.05, 1.5), random.uniform(0.05, 0.4)}};
}

Body random_body(RandomStream& random, Vec2 middle) {
  const double bottom = random.uniform(0.0, 0.4);
  return {random_shape(random, middle), bottom, bottom + random.uniform(0.1, 0.5)};
}

// Returns a world with one long wall and obstacles at random places.
WorldModel world_of(RandomStream& random, Vec2 at, int things) {
  WorldModel world{"things", {{"wall", Box{{at.x, at.y + 4.0, 0.3}, {5.0, 0.1}}, 2.0}}, {}};
  for (int i = 0; i < things; ++i) {
    const double bottom = random.uniform(0.0, 0.4);
    world.obstacles.push_back({"thing", random_shape(random, at), bottom + random.uniform(0.1, 0.5)});
    world.obstacles.back().bottom = bottom;
  }
  return world;
}

// A world of obstacles with some moving bodies.
struct Crowd {
  Crowd(RandomStream& random, Vec2 at, std::size_t count, int things = 0)
      : middle(at), caster(world_of(random, at, things)) {
    for (std::size_t i = 0; i < count; ++i) caster.add_body(random_body(random, at));
  }
  Vec2 middle;
  Caster caster;
};

struct Sight {
  Ray axis;
  double half_angle;
  double slack;
};

Sight random_sight(RandomStream& random, const Crowd& crowd, std::size_t bodies) {
  const Vec2 at = crowd.middle + Vec2{random.uniform(-5, 5), random.uniform(-5, 5)};
  const auto own = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(bodies)));
  return {{at, direction(random.uniform(-kPi, kPi)), random.uniform(0.5, 9.0), random.uniform(0.0, 0.9), own},
          random.chance(0.1) ? random.uniform(0.0, 3.0) : random.uniform(0.0, 0.5),
          random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.3)};
}

// Returns a ray that the view allows: direction and origin lie at their limit as often as inside it.
Ray random_ray(RandomStream& random, const Sight& sight) {
  const auto up_to = [&](double most) { return random.chance(0.5) ? most : random.uniform(0.0, most); };
  Ray ray = sight.axis;
  const double side = random.chance(0.5) ? 1.0 : -1.0;
  ray.direction = rotated(ray.direction, side * up_to(sight.half_angle));
  ray.origin = ray.origin + up_to(sight.slack) * direction(random.uniform(-kPi, kPi));
  return ray;
}

// @return  how many of the rays met something.
int compare(RandomStream& random, const Crowd& crowd, const Sight& sight, Caster::View& view) {
  view.look(crowd.caster, sight.axis, sight.half_angle, sight.slack);
  int met = 0;
  for (int i = 0; i < 20; ++i) {
    const Ray ray = random_ray(random, sight);
    const Hit seen = view.cast(ray);
    const Hit alone = crowd.caster.cast(ray);
    REQUIRE(seen.range == alone.range);
    REQUIRE(seen.surface == alone.surface);
    REQUIRE(seen.point == alone.point);
    met += alone.found() ? 1 : 0;
  }
  return met;
}

}  // namespace

TEST_CASE("a ray of a view meets the same obstacle as a single ray, also far from the origin",
          "[sim][caster]") {
  const std::size_t bodies = GENERATE(3U, 40U, 299U, 320U);
  const int things = GENERATE(0, 7, 60);
  const Vec2 middle = GENERATE(Vec2{0.0, 0.0}, Vec2{-9000.0, 4000.0});
  RandomStream random(11, "test", "views");
  Crowd crowd(random, middle, bodies, things);
  Caster::View view;
  int met = 0;
  for (int i = 0; i < 200; ++i) met += compare(random, crowd, random_sight(random, crowd, bodies), view);
  CHECK(met > 400);
}

TEST_CASE("a view sees bodies where they have gone, and none that were removed", "[sim][caster]") {
  RandomStream random(12, "test", "views");
  Crowd crowd(random, {}, 60);
  Caster::View view;
  for (std::size_t i = 0; i < 60; ++i) {
    crowd.caster.move_body(i, random_shape(random, {}));
    if (i % 3 == 0) crowd.caster.remove_body(i);
    if (i % 6 == 0) crowd.caster.move_body(i, random_shape(random, {}));
    (void)compare(random, crowd, random_sight(random, crowd, 60), view);
  }
  const Ray ray{{0, 0}, {1, 0}, 9.0, 0.3};
  Caster posts({"nothing", {}, {}});
  for (int i = 0; i < 10; ++i) posts.add_body({Circle{{2.0 + i, 0.0}, 0.5}, 0.0, 1.0});
  for (std::size_t i = 0; i < 9; ++i) posts.remove_body(i);
  CHECK_FALSE(Caster::View(posts, ray, 0.1).cast(ray).found());
  posts.move_body(9, Circle{{4.0, 0.0}, 0.5});
  CHECK(Caster::View(posts, ray, 0.1).cast(ray).range == Approx(3.5));
}
