// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/reeds_shepp.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "orca/base/random.hpp"

using namespace orca;
using namespace orca::nav;

namespace {

Pose2 random_pose(RandomStream& random) {
  return {random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0),
          random.uniform(-std::numbers::pi, std::numbers::pi)};
}

Pose2 end_of(Pose2 pose, const std::vector<WayPiece>& way) {
  for (const WayPiece& piece : way) pose = driven(pose, piece, piece.length);
  return pose;
}

}  // namespace

TEST_CASE(
    "the shortest way of a robot that steers leads to the pose asked for, in no smaller circle than allowed",
    "[navigation][hybrid]") {
  RandomStream random(1, "test", "poses");
  for (int i = 0; i < 20'000; ++i) {
    const Pose2 from = random_pose(random);
    const Pose2 to = random_pose(random);
    const double radius = random.uniform(0.3, 2.0);
    const auto way = shortest_way(from, to, radius);
    const Pose2 end = end_of(from, way);
    CAPTURE(i, radius, from.x, from.y, from.yaw, to.x, to.y, to.yaw);
    REQUIRE(norm(end.position() - to.position()) < 1e-6);
    REQUIRE(std::fabs(wrapped(end.yaw - to.yaw)) < 1e-6);
    for (const WayPiece& piece : way) REQUIRE(std::fabs(piece.curvature) <= 1.0 / radius + 1e-12);
    REQUIRE(length_of(way) >= norm(to.position() - from.position()) - 1e-9);
  }
}

TEST_CASE("no detour by a third pose is shorter than the shortest way, and the way back is as long",
          "[navigation][hybrid]") {
  RandomStream random(2, "test", "poses");
  for (int i = 0; i < 20'000; ++i) {
    const Pose2 a = random_pose(random);
    const Pose2 b = random_pose(random);
    const Pose2 c = random_pose(random);
    CAPTURE(i, a.x, a.y, a.yaw, b.x, b.y, b.yaw, c.x, c.y, c.yaw);
    const double direct = length_of(shortest_way(a, c, 1.0));
    REQUIRE(direct <= length_of(shortest_way(a, b, 1.0)) + length_of(shortest_way(b, c, 1.0)) + 1e-6);
    REQUIRE(direct == Approx(length_of(shortest_way(c, a, 1.0))).epsilon(1e-6));
  }
}

TEST_CASE("ways whose length is known by hand come out so", "[navigation][hybrid]") {
  const double pi = std::numbers::pi;
  CHECK(length_of(shortest_way({0, 0, 0}, {3, 0, 0}, 0.7)) == Approx(3.0));
  CHECK(length_of(shortest_way({0, 0, 0}, {-3, 0, 0}, 0.7)) == Approx(3.0));
  CHECK(length_of(shortest_way({0, 0, 0}, {1, 1, pi / 2}, 1.0)) == Approx(pi / 2));
  // Turning round where it stands: three arcs of 60 degrees.
  CHECK(length_of(shortest_way({0, 0, 0}, {0, 0, pi}, 1.0)) == Approx(pi));
}
