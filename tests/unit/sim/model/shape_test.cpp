// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/sim/world_model.hpp"

using namespace orca::sim;
using orca::Pose2;
using orca::Vec2;

TEST_CASE("an outline is turned counter-clockwise, so the solid lies left of each edge", "[sim][shape]") {
  const Outline clockwise = outline_of({{0, 0}, {0, 1}, {1, 1}, {1, 0}});
  REQUIRE(clockwise.edges.size() == 4);
  for (const Segment& e : clockwise.edges) CHECK(cross(e.b - e.a, Vec2{0.5, 0.5} - e.a) > 0.0);
}

TEST_CASE("the edges of a box follow from its pose", "[sim][shape]") {
  const Shape box = Box{{1.0, 2.0, 0.5 * std::numbers::pi}, {0.5, 0.1}};
  CHECK(contains(box, {1.0, 2.4}));
  CHECK_FALSE(contains(box, {1.4, 2.0}));
  CHECK(distance(box, {1.0, 3.0}) == Approx(0.5));
  CHECK(distance(box, {1.0, 2.0}) == 0.0);
}

TEST_CASE("an outline with a hole is solid between its loops only", "[sim][shape]") {
  Outline ring = outline_of({{0, 0}, {4, 0}, {4, 4}, {0, 4}});
  for (const Segment& e : outline_of({{1, 1}, {3, 1}, {3, 3}, {1, 3}}).edges)
    ring.edges.push_back({e.b, e.a});
  CHECK(contains(ring, {0.5, 2.0}));
  CHECK_FALSE(contains(ring, {2.0, 2.0}));
  CHECK(distance(ring, {2.0, 2.0}) == Approx(1.0));
}

TEST_CASE("two solids overlap if they cross or one contains the other, and not if they are apart",
          "[sim][shape]") {
  const Shape big = Box{{0, 0, 0}, {2, 2}};
  const Shape small = Box{{0.5, 0.5, 0.3}, {0.1, 0.1}};
  const Shape bar = Box{{0, 0, 0.1}, {5, 0.1}};
  const Shape far = Box{{5, 5, 0.7}, {0.5, 0.5}};
  CHECK(overlap(big, small));
  CHECK(overlap(small, big));
  CHECK(overlap(big, bar));
  CHECK_FALSE(overlap(big, far));
  CHECK(overlap(Circle{{2.15, 0}, 0.2}, big));
  CHECK_FALSE(overlap(big, Circle{{2.25, 0}, 0.2}));
}

TEST_CASE("a pose carries points of its frame into the world", "[sim][shape]") {
  const Pose2 pose = Pose2{1, 2, 0.5 * std::numbers::pi} * Pose2{1, 0, std::numbers::pi};
  CHECK(pose.x == Approx(1.0));
  CHECK(pose.y == Approx(3.0));
  CHECK(pose.yaw == Approx(-0.5 * std::numbers::pi));
}

TEST_CASE("a world finds its places by name and the obstacle that a body would stand in", "[sim][world]") {
  const WorldModel world{"w", {{"desk", Box{{2, 0, 0}, {1, 1}}, 0.7}}, {{"start", {0, 0, 0}}}};
  REQUIRE(world.place("start") != nullptr);
  CHECK(world.place("stat") == nullptr);
  const Obstacle* desk = world.obstacle_at(Circle{{1.1, 0}, 0.2}, 0.0);
  REQUIRE(desk != nullptr);
  CHECK(desk->name == "desk");
  CHECK(world.obstacle_at(Circle{{1.1, 0}, 0.2}, 0.8) == nullptr);
  CHECK(world.bounds().high.x == 3.0);
}
