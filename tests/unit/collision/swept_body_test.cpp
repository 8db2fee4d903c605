// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/collision/swept_body.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/arc.hpp"

using namespace orca::collision;
using orca::Pose2;
using orca::Travel2;
using orca::Vec2;

namespace {

constexpr double kExact = 2e-4;  // [m] of FCL's distances, whose posts are that wide

std::vector<Vec2> box(double x, double y, double length, double width) {
  return {{x - 0.5 * length, y - 0.5 * width},
          {x + 0.5 * length, y - 0.5 * width},
          {x + 0.5 * length, y + 0.5 * width},
          {x - 0.5 * length, y + 0.5 * width}};
}

// A flat base, a mast behind, and a tray on top that juts out in front.
const std::array<Solid, 3> kTall{Solid{box(0.0, 0.0, 0.5, 0.4), 0.0, 0.05, 0.25},
                                 Solid{{{-0.15, 0.0}}, 0.06, 0.25, 1.1},
                                 Solid{box(0.1, 0.0, 0.6, 0.3), 0.0, 0.8, 0.9}};

std::span<const Solid> first(std::size_t count) { return std::span<const Solid>(kTall).first(count); }

Vec2 nearest_on(Vec2 a, Vec2 b, Vec2 p) {
  const Vec2 way = b - a;
  return a + std::clamp(dot(p - a, way) / dot(way, way), 0.0, 1.0) * way;
}

// The distance of a plan and a place, 0 within, by looking at each edge.
double plan_distance(const Solid& solid, Vec2 p) {
  if (solid.corners.size() == 1) return std::max(0.0, norm(p - solid.corners[0]) - solid.radius);
  bool within = true;
  double least = 1e9;
  for (std::size_t i = 0; i < solid.corners.size(); ++i) {
    const Vec2 a = solid.corners[i], b = solid.corners[(i + 1) % solid.corners.size()];
    within = within && cross(b - a, p - a) >= 0.0;
    least = std::min(least, norm(p - nearest_on(a, b, p)));
  }
  return within ? 0.0 : least;
}

double plain_distance(std::span<const Solid> solids, const Post& post) {
  double least = Approach::kFar;
  for (const Solid& solid : solids) {
    const double above = std::max({0.0, post.bottom - solid.top, solid.bottom - post.top});
    least = std::min(least, orca::portable::hypot(plan_distance(solid, post.place), above));
  }
  return least;
}

Pose2 at(const Travel2& travel, double share) {
  return orca::along_arc({}, {share * travel.forward, share * travel.left, share * travel.turn});
}

double least_distance(std::span<const Solid> solids, const Pose2& there, std::span<const Post> posts) {
  double least = Approach::kFar;
  for (const Post& post : posts)
    least = std::min(least, plain_distance(solids, {seen_from(there, post.place), post.bottom, post.top}));
  return least;
}

Post random_post(orca::RandomStream& random) {
  const double bottom = random.uniform(0.0, 1.2);
  return {{random.uniform(-1.0, 1.5), random.uniform(-1.0, 1.0)},
          random.uniform(0.0, 1.0) < 0.5 ? 0.0 : bottom,
          bottom + random.uniform(0.01, 0.5)};
}

}  // namespace

TEST_CASE("FCL's distance of a body and a post is that of their nearest points in space", "[collision]") {
  const SweptBody body(kTall);
  orca::RandomStream random(1, "test", "posts");
  for (int i = 0; i < 3000; ++i) {
    const Post post = random_post(random);
    const double expected = plain_distance(kTall, post);
    CAPTURE(post.place.x, post.place.y, post.bottom, post.top);
    if (expected > 0.0) CHECK(std::abs(body.distance(post) - expected) < kExact);
    if (expected == 0.0) CHECK(body.distance(post) <= 0.0);
  }
}

TEST_CASE("a motion is free exactly up to where sampled poses come nearer to a post than the margin",
          "[collision]") {
  const SweptBody body(kTall);
  orca::RandomStream random(2, "test", "motions");
  int ended = 0;
  for (int run = 0; run < 1000; ++run) {
    std::vector<Post> posts;
    for (int i = 0; i < 15; ++i) {
      const Post post = random_post(random);
      if (plain_distance(kTall, post) > 0.05) posts.push_back(post);
    }
    const Travel2 travel{random.uniform(-0.5, 1.0), random.uniform(-0.2, 0.2), random.uniform(-1.5, 1.5)};
    const double margin = random.uniform(0.005, 0.05);
    const Approach approach = body.along(travel, posts, margin);
    const double length =
        orca::portable::hypot(travel.forward, travel.left) + body.reach() * std::abs(travel.turn);
    CAPTURE(run, travel.forward, travel.left, travel.turn, margin, approach.share);
    double least = Approach::kFar;
    for (int i = 0; i <= 400; ++i)
      least = std::min(least, least_distance(kTall, at(travel, approach.share * i / 400), posts));
    // Between two looks a post can come nearer by half of a step.
    CHECK(least > margin - 0.5 * SweptBody::kStep - kExact);
    if (!approach.post) continue;
    ++ended;
    const double beyond =
        std::min(1.0, approach.share + 1.01 * SweptBody::kStep / length + 2.0 * kExact / length);
    double after = Approach::kFar;
    for (int i = 0; i <= 40; ++i) {
      const double share = approach.share + (beyond - approach.share) * i / 40;
      after = std::min(after, least_distance(kTall, at(travel, share), posts));
    }
    CHECK(after < margin + kExact);
  }
  CHECK(ended > 300);
}

TEST_CASE("heights count: a low body passes under a table top that holds a tall one", "[collision]") {
  const std::array top{Post{{0.8, 0.0}, 0.7, 0.75}};
  CHECK_FALSE(SweptBody(first(1)).along({1.5, 0.0, 0.0}, top, 0.02).post);
  const Approach mast = SweptBody(first(2)).along({1.5, 0.0, 0.0}, top, 0.02);
  REQUIRE(mast.post);
  CHECK(std::abs(1.5 * mast.share - (0.8 + 0.15 - 0.06 - 0.02)) < 0.003);
  const std::array higher{Post{{0.8, 0.0}, 0.82, 0.86}};
  const Approach tray = SweptBody(kTall).along({1.5, 0.0, 0.0}, higher, 0.02);
  CHECK(std::abs(1.5 * tray.share - (0.8 - 0.4 - 0.02)) < 0.003);
}

TEST_CASE("the way straight up to a post is free to the margin, however far away it is", "[collision]") {
  const SweptBody body(first(1));
  for (double gap = 0.05; gap < 0.6; gap += 0.01) {
    const std::array ahead{Post{{0.25 + gap, 0.0}}};
    CAPTURE(gap);
    CHECK(std::abs(0.7 * body.along({0.7, 0.0, 0.0}, ahead, 0.02).share - (gap - 0.02)) <
          SweptBody::kStep + kExact);
  }
}

TEST_CASE("a body may leave what is within its margin, and must not come nearer to it", "[collision]") {
  const SweptBody body(kTall);
  const std::array near{Post{{0.26, 0.0}, 0.0, 0.3}};
  CHECK_FALSE(body.along({-0.3, 0.0, 0.0}, near, 0.03).post);
  CHECK_FALSE(body.along({0.0, 0.3, 0.0}, near, 0.03).post);
  const Approach on = body.along({0.3, 0.0, 0.0}, near, 0.03);
  REQUIRE(on.post);
  CHECK(0.3 * on.share < 0.004);
  const std::array inside{Post{{0.24, 0.0}, 0.0, 0.3}};
  CHECK_FALSE(body.along({-0.3, 0.0, 0.0}, inside, 0.03).post);
  CHECK(body.along({0.3, 0.0, 0.0}, inside, 0.03).post);
}

TEST_CASE("what lies deep within the body is the robot itself", "[collision]") {
  const std::array own{Post{{0.1, 0.0}, 0.0, 0.3}};
  CHECK_FALSE(SweptBody(kTall).along({0.5, 0.0, 0.5}, own, 0.03).post);
}

TEST_CASE("a body that turns on the spot meets with its corners what its circle would meet", "[collision]") {
  const SweptBody body(first(1));
  const double reach = std::hypot(0.25, 0.2);
  const std::array beside{Post{{0.0, 0.5 * (0.2 + reach)}, 0.0, 1.0}};
  CHECK(body.along({0.0, 0.0, 1.5}, beside, 0.0).post);
  const std::array beyond{Post{{0.0, reach + 0.01}, 0.0, 1.0}};
  CHECK_FALSE(body.along({0.0, 0.0, 1.5}, beyond, 0.0).post);
}

TEST_CASE("solids without a volume are left out, and a body without solids meets nothing", "[collision]") {
  const std::array none{Solid{}, Solid{{{0.0, 0.0}, {1.0, 0.0}}, 0.0, 0.0, 1.0},
                        Solid{{{0.0, 0.0}}, 0.2, 0.5, 0.5}};
  const SweptBody body(none);
  CHECK(body.is_empty());
  CHECK(body.reach() == 0.0);
  CHECK_FALSE(body.along({1.0, 0.0, 0.0}, std::array{Post{{0.5, 0.0}}}, 0.02).post);
}

TEST_CASE("a motion among the echoes of a corridor is judged in less than a millisecond",
          "[collision][quiet]") {
  const std::array pioneer{Solid{box(-0.0445, 0.0, 0.511, 0.14), 0.0, 0.07, 0.22},
                           Solid{box(-0.0445, 0.0, 0.463, 0.2), 0.0, 0.07, 0.22},
                           Solid{box(-0.0445, 0.0, 0.375, 0.306), 0.0, 0.07, 0.22},
                           Solid{box(0.0, 0.0, 0.165, 0.425), 0.0, 0.0, 0.165},
                           Solid{box(0.017, 0.008, 0.156, 0.155), 0.0, 0.22, 0.43}};
  const SweptBody body(pioneer);
  std::vector<Post> posts;
  for (int i = 0; i < 190; ++i)
    for (const double side : {-0.35, 0.35}) posts.push_back({{-1.0 + 0.02 * i, side}});
  constexpr int kMotions = 200;
  std::vector<double> times;
  for (int i = 0; i < kMotions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const Approach approach = body.along({0.5, 0.0, 0.002 * i}, posts, 0.02);
    times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    CHECK(approach.clearance < 0.2);
  }
  std::ranges::nth_element(times, times.begin() + kMotions / 2);
  CHECK(times[kMotions / 2] < 1e-3);
}

TEST_CASE(
    "the distance of a plan is exact beside its edges, too little beside its corners, and negative within",
    "[collision]") {
  const SweptBody box(first(1));
  CHECK(box.plan_distance({0.55, 0.0}) == Approx(0.3));
  CHECK(box.plan_distance({0.0, -0.5}) == Approx(0.3));
  CHECK(box.plan_distance({0.0, 0.1}) == Approx(-0.1));
  const double corner =
      std::hypot(0.3, 0.4);  // of a place 0.3 m ahead of the front and 0.4 m beside the side
  CHECK(box.plan_distance({0.55, 0.6}) <= corner);
  CHECK(box.plan_distance({0.55, 0.6}) >= 0.4);
}
