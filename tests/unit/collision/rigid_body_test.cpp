// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/base/random.hpp"
#include "orca/collision/rigid_body.hpp"
#include "orca/geometry/pose2.hpp"

using namespace orca;
using namespace orca::collision;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace {

Isometry3d at(double x, double y, double z) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation() << x, y, z;
  return pose;
}

Isometry3d drawn_pose(RandomStream& random) {
  const auto part = [&] { return random.uniform(-1.0, 1.0); };
  Isometry3d pose = at(part(), part(), part());
  pose.linear() = Eigen::Quaterniond(part(), part(), part(), part()).normalized().toRotationMatrix();
  return pose;
}

// Returns the distance [m] of a point from a block around the origin, 0 within.
double off_block(const Vector3d& point, const Vector3d& lengths) {
  return (point.cwiseAbs() - 0.5 * lengths).cwiseMax(0.0).norm();
}

// Returns the distance [m] of a point from an upright cylinder around the origin, 0 within.
double off_cylinder(const Vector3d& point, double radius, double length) {
  const double aside = std::max(0.0, point.head<2>().norm() - radius);
  return std::hypot(aside, std::max(0.0, std::fabs(point.z()) - 0.5 * length));
}

std::vector<Vector3d> corners_of(const Vector3d& lengths) {
  std::vector<Vector3d> corners;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5})
        corners.emplace_back(x * lengths.x(), y * lengths.y(), z * lengths.z());
  return corners;
}

std::vector<Facet> facets_of(const Vector3d& lengths) {
  const std::vector<Vector3d> c = corners_of(lengths);
  std::vector<Facet> facets;
  for (const auto& side : {std::array{0, 1, 3, 2}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                           std::array{2, 3, 7, 6}, std::array{0, 2, 6, 4}, std::array{1, 3, 7, 5}}) {
    const auto corner = [&](std::size_t i) { return c[static_cast<std::size_t>(side.at(i))]; };
    facets.push_back({corner(0), corner(1), corner(2)});
    facets.push_back({corner(0), corner(2), corner(3)});
  }
  return facets;
}

}  // namespace

TEST_CASE("a ball meets a block, a cylinder, a hull and a surface where its middle is nearer than its radius",
          "[collision]") {
  constexpr double kRadius = 0.3;
  const Vector3d lengths(0.8, 0.5, 0.3);
  RandomStream random(1, "test", "balls");
  RigidBody ball, block, cylinder, hull, surface;
  ball.add_ball(Vector3d::Zero(), kRadius);
  block.add_block(Isometry3d::Identity(), lengths);
  cylinder.add_cylinder(Isometry3d::Identity(), 0.4, 0.6);
  hull.add_hull(corners_of(lengths));
  surface.add_surface(facets_of(lengths));
  int met = 0;
  for (int i = 0; i < 1000; ++i) {
    const Isometry3d X_AB = drawn_pose(random);
    const Vector3d middle = X_AB.translation();
    const double gap = off_block(middle, lengths) - kRadius;
    const double round_gap = off_cylinder(middle, 0.4, 0.6) - kRadius;
    CAPTURE(i, gap, round_gap);
    if (std::fabs(gap) > 3.0 * RigidBody::kTouch) {
      CHECK(block.meets(ball, X_AB) == (gap < 0.0));
      CHECK(hull.meets(ball, X_AB) == (gap < 0.0));
      CHECK(ball.meets(hull, X_AB.inverse()) == (gap < 0.0));
      met += gap < 0.0 ? 1 : 0;
    }
    if (std::fabs(round_gap) > 3.0 * RigidBody::kTouch)
      CHECK(cylinder.meets(ball, X_AB) == (round_gap < 0.0));
    // The ball is wider than the block is high, so it touches the surface of the block wherever it meets the block.
    if (std::fabs(gap) > 3.0 * RigidBody::kTouch) CHECK(surface.meets(ball, X_AB) == (gap < 0.0));
  }
  CHECK(met > 100);
  CHECK(met < 900);
}

TEST_CASE("blocks, hulls and surfaces of the same form meet the same blocks", "[collision]") {
  const Vector3d lengths(0.8, 0.5, 0.3);
  RandomStream random(2, "test", "blocks");
  RigidBody block, hull, surface;
  block.add_block(Isometry3d::Identity(), lengths);
  hull.add_hull(corners_of(lengths));
  surface.add_surface(facets_of(lengths));
  int met = 0;
  for (int i = 0; i < 1000; ++i) {
    const Isometry3d X_AB = drawn_pose(random);
    CAPTURE(i);
    const bool meets = block.meets(block, X_AB);
    CHECK(block.meets(hull, X_AB) == meets);
    CHECK(surface.meets(block, X_AB) == meets);
    met += meets ? 1 : 0;
  }
  CHECK(met > 100);
  CHECK(met < 900);
}

TEST_CASE("bodies that only touch do not meet, and a surface does not meet what it holds", "[collision]") {
  RigidBody one, other, room, nothing;
  one.add_block(Isometry3d::Identity(), {1.0, 1.0, 1.0});
  other.add_cylinder(Isometry3d::Identity(), 0.5, 1.0);
  room.add_surface(facets_of({3.0, 3.0, 3.0}));
  nothing.add_surface({});
  CHECK_FALSE(one.meets(other, at(1.0, 0.0, 0.0)));
  CHECK_FALSE(one.meets(other, at(0.0, 0.0, 1.0)));
  CHECK(one.meets(other, at(0.999, 0.0, 0.0)));
  CHECK(one.meets(other, at(0.0, 0.0, 0.999)));
  CHECK_FALSE(room.meets(one, at(0.0, 0.0, 0.0)));
  CHECK(room.meets(one, at(1.1, 0.0, 0.0)));
  CHECK_FALSE(nothing.meets(one, at(0.0, 0.0, 0.0)));
}
