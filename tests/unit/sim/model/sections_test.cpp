// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/base/random.hpp"
#include "orca/sim/sections.hpp"

using namespace orca::sim;
using orca::RandomStream;
using orca::Vec2;

namespace {

// The reference: whether a point lies in a part, from the definition of its form in its own frame. It rotates by
// the quaternion product, and knows no sections.
Vec3 in_part(const Pose3& X, const Vec3& p) {
  const Vec3 d{p.x - X.x, p.y - X.y, p.z - X.z};
  const auto crossed = [](const Vec3& a, const Vec3& b) {
    return Vec3{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  };
  const Vec3 back{-X.qx, -X.qy, -X.qz};
  const Vec3 t = crossed(back, d);
  const Vec3 u = crossed(back, {t.x + X.qw * d.x, t.y + X.qw * d.y, t.z + X.qw * d.z});
  return {d.x + 2 * u.x, d.y + 2 * u.y, d.z + 2 * u.z};
}

// Returns how deep the point lies in the part [m], at most; negative outside.
double depth(const Part& part, const Vec3& point) {
  const Vec3 p = in_part(part.X_BP, point);
  if (const auto* b = std::get_if<Part::Block>(&part.form))
    return std::min({0.5 * b->x - std::fabs(p.x), 0.5 * b->y - std::fabs(p.y), 0.5 * b->z - std::fabs(p.z)});
  if (const auto* c = std::get_if<Part::Cylinder>(&part.form))
    return std::min(c->radius - std::hypot(p.x, p.y), 0.5 * c->length - std::fabs(p.z));
  if (const auto* ball = std::get_if<Part::Ball>(&part.form)) return ball->radius - std::hypot(p.x, p.y, p.z);
  // The hull of the tests is the octahedron |x| / 0.3 + |y| / 0.2 + |z| / 0.4 <= 1.
  const double flat = std::hypot(1 / 0.3, 1 / 0.2, 1 / 0.4);
  return (1.0 - std::fabs(p.x) / 0.3 - std::fabs(p.y) / 0.2 - std::fabs(p.z) / 0.4) / flat;
}

const std::vector<decltype(Part::form)> kForms{
    Part::Block{0.5, 0.3, 0.2}, Part::Cylinder{0.2, 0.5}, Part::Ball{0.25},
    Part::Hull{{{0.3, 0, 0}, {-0.3, 0, 0}, {0, 0.2, 0}, {0, -0.2, 0}, {0, 0, 0.4}, {0, 0, -0.4}}}};

Pose3 turned(double angle, const Vec3& axis) {
  const double s = std::sin(0.5 * angle) / std::hypot(axis.x, axis.y, axis.z);
  return {0.1, -0.2, 0.5, s * axis.x, s * axis.y, s * axis.z, std::cos(0.5 * angle)};
}

// Returns one of many poses: any, upright, lying, upside down.
Pose3 some_pose(RandomStream& random) {
  const double angle = random.uniform(-3.0, 3.0);
  const auto any = [&] { return random.uniform(-1.0, 1.0); };
  switch (static_cast<int>(random.uniform(0.0, 4.0))) {
    case 0: return turned(angle, {0, 0, 1});
    case 1: return turned(0.5 * std::numbers::pi, {std::cos(angle), std::sin(angle), 0});
    case 2: return turned(std::numbers::pi, {std::cos(angle), std::sin(angle), 0});
    default: return turned(angle, {any(), any(), any()});
  }
}

// The prism around a tilted cylinder of 0.2 m reaches 0.06 mm beyond it.
constexpr double kSectionTolerance = 1e-4;

bool any_contains(const std::vector<Shape>& plans, Vec2 p) {
  return std::ranges::any_of(plans, [&](const Shape& plan) { return contains(plan, p); });
}

}  // namespace

TEST_CASE("a point lies in the section of a part exactly where it lies in the part", "[sim][sections]") {
  RandomStream random(1, "sections", "points");
  int inside = 0, outside = 0, judged = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    const Part part{kForms[static_cast<std::size_t>(trial) % kForms.size()], some_pose(random)};
    const double height = random.uniform(0.0, 1.0);
    const std::vector<Shape> section = sections_at({part}, height);
    REQUIRE(section.size() <= 1);
    for (int i = 0; i < 50; ++i) {
      const Vec2 p{random.uniform(-0.3, 0.5), random.uniform(-0.6, 0.2)};
      const double deep = depth(part, {p.x, p.y, height});
      if (std::fabs(deep) < kSectionTolerance) continue;
      ++judged;
      (deep > 0.0 ? inside : outside) += 1;
      if (any_contains(section, p) != (deep > 0.0)) FAIL("trial " << trial << " " << deep);
    }
  }
  CHECK(judged > 190'000);
  CHECK(inside > 10'000);
  CHECK(outside > 20'000);
}

TEST_CASE("a point lies in the plan between two heights if the part has a point above it there",
          "[sim][sections]") {
  RandomStream random(2, "sections", "columns");
  int inside = 0, outside = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Part part{kForms[static_cast<std::size_t>(trial) % kForms.size()], some_pose(random)};
    const double low = random.uniform(0.0, 0.9);
    const double high = low + random.uniform(0.01, 0.3);
    const std::vector<Shape> plan = plans_between({part}, low, high);
    for (int i = 0; i < 20; ++i) {
      const Vec2 p{random.uniform(-0.3, 0.5), random.uniform(-0.6, 0.2)};
      double deepest = -1.0;
      for (int k = 0; k <= 400; ++k)
        deepest = std::max(deepest, depth(part, {p.x, p.y, low + (high - low) * k / 400.0}));
      if (std::fabs(deepest) < 1e-3) continue;  // Heights lie up to 0.75 mm apart.
      (deepest > 0.0 ? inside : outside) += 1;
      if (any_contains(plan, p) != (deepest > 0.0)) FAIL("trial " << trial << " " << deepest);
    }
  }
  CHECK(inside > 4'000);
  CHECK(outside > 5'000);
}

TEST_CASE("a part is cut from its bottom on and below its top", "[sim][sections]") {
  const std::vector<Part> parts{{Part::Block{0.4, 0.4, 0.2}, {0, 0, 0.1}},
                                {Part::Cylinder{0.1, 0.3}, {0, 0, 0.35}}};
  CHECK(sections_at(parts, 0.0).size() == 1);
  CHECK(sections_at(parts, 0.15).size() == 1);
  CHECK(std::holds_alternative<Circle>(sections_at(parts, 0.2).at(0)));
  CHECK(sections_at(parts, 0.5).empty());
  CHECK(sections_at(parts, -0.01).empty());
}

TEST_CASE("what only touches a range of heights is not in it", "[sim][sections]") {
  const std::vector<Part> block{{Part::Block{0.4, 0.4, 0.2}, {0, 0, 0.5}}};
  CHECK(plans_between(block, 0.0, 0.4).empty());
  CHECK(plans_between(block, 0.6, 1.0).empty());
  CHECK(plans_between(block, 0.0, 0.401).size() == 1);
  CHECK(plans_between(block, 0.45, 0.46).size() == 1);
  CHECK(plans_between({{Part::Ball{0.1}, {0, 0, 0.5}}}, 0.0, 0.4).empty());
}

TEST_CASE("a ball between two heights is as wide as its widest section there", "[sim][sections]") {
  const std::vector<Part> ball{{Part::Ball{0.5}, {1, 2, 0.5}}};
  CHECK(std::get<Circle>(plans_between(ball, 0.0, 0.2).at(0)).radius == Approx(0.4));
  CHECK(std::get<Circle>(plans_between(ball, 0.8, 2.0).at(0)).radius == Approx(0.4));
  CHECK(std::get<Circle>(plans_between(ball, 0.3, 0.6).at(0)).radius == 0.5);
  CHECK(std::get<Circle>(sections_at(ball, 0.9).at(0)).radius == Approx(0.3));
}

TEST_CASE("a wheel that stands upright is cut to a rectangle of exact size", "[sim][sections]") {
  const double s = std::sqrt(0.5);
  const std::vector<Part> wheel{{Part::Cylinder{0.1, 0.04}, {0, 0, 0.1, s, 0, 0, s}}};  // Axis along y.
  const Bounds b = bounds_of(sections_at(wheel, 0.16).at(0));
  CHECK(b.high.x == Approx(0.08));
  CHECK(b.low.x == Approx(-0.08));
  CHECK(b.high.y == Approx(0.02));
  CHECK(edges_of(sections_at(wheel, 0.16).at(0)).size() == 4);
}

TEST_CASE("a part without area at a height has no section there", "[sim][sections]") {
  CHECK(sections_at({{Part::Ball{0.1}, {0, 0, 0.1}}}, 0.0).empty());
  CHECK(sections_at({{Part::Hull{{{0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {0, 0, 1}}}, {}}}, 0.0).empty());
  CHECK(sections_at({{Part::Hull{}, {}}}, 0.0).empty());
  CHECK(plans_between({{Part::Ball{0.1}, {0, 0, 0.1}}}, 0.1, 0.1).empty());
}

TEST_CASE("each plan of an upright part equals its section at any of its heights", "[sim][sections]") {
  const Part block{Part::Block{0.5, 0.3, 0.2}, turned(0.7, {0, 0, 1})};
  const auto low = edges_of(sections_at({block}, 0.41).at(0));
  CHECK(is_upright(block));
  CHECK(low == edges_of(sections_at({block}, 0.59).at(0)));
  CHECK(low == edges_of(plans_between({block}, 0.0, 1.0).at(0)));
  CHECK_FALSE(is_upright({Part::Block{0.5, 0.3, 0.2}, turned(0.7, {1, 1, 1})}));
  CHECK_FALSE(is_upright({Part::Ball{0.5}, {}}));
}
