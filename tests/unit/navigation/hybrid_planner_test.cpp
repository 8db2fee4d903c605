// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/hybrid_planner.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "grids.hpp"
#include "orca/base/random.hpp"
#include "orca/navigation/path_planner.hpp"
#include "steered_ways.hpp"

using namespace orca;
using namespace orca::nav;
using namespace orca::test;

namespace {

constexpr Footprint kCar{0.4, 0.2, 0.45};
constexpr double kRadius = 0.8;
constexpr double kMargin = 0.015;

/// A planner over a floor.
struct Trial {
  explicit Trial(FloorGrid floor) : grid(std::move(floor)), map(grid), paths(kShortest) {
    paths.look_at(map, kCar, {});
    planner.look_at(map, kCar, paths.costs(), {}, kRadius, kMargin);
  }
  FloorGrid grid;
  OccupancyMap map;
  PathPlanner paths;
  HybridPlanner planner;
};

Pose2 end_of(const Pose2& start, const SteeredPlan& plan) { return poses_on(start, plan.pieces, 0.5).back(); }

int cusps_of(const SteeredPlan& plan) {
  int count = 0;
  for (std::size_t i = 1; i < plan.pieces.size(); ++i)
    count += plan.pieces[i].length * plan.pieces[i - 1].length < 0.0 ? 1 : 0;
  return count;
}

bool is_free(const Trial& trial, const Pose2& start, const SteeredPlan& plan) {
  return std::ranges::none_of(poses_on(start, plan.pieces, 0.005),
                              [&](const Pose2& pose) { return touches(trial.grid, kCar, pose); });
}

}  // namespace

TEST_CASE("the outline is tried as exactly as by separating axes", "[navigation][hybrid]") {
  RandomStream random(1, "test", "poses");
  OutlineGrid outline;
  Trial trial(two_rooms_grid());
  outline.look_at(trial.map, kCar, 0.0);
  int touching = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Pose2 pose{random.uniform(0.0, 10.0), random.uniform(0.0, 6.0), random.uniform(-3.1, 3.1)};
    CAPTURE(pose.x, pose.y, pose.yaw);
    REQUIRE((outline.touched(pose) > 0) == touches(trial.grid, kCar, pose));
    touching += outline.touched(pose) > 0 ? 1 : 0;
  }
  CHECK(touching > 2'000);
  CHECK(touching < 18'000);
}

TEST_CASE("a circle cuts the corners of the outline that is tried, and nothing that the robot covers",
          "[navigation][hybrid]") {
  RandomStream random(2, "test", "poses");
  Trial trial(two_rooms_grid());
  OutlineGrid cut;
  OutlineGrid circle;
  const double radius = 0.5 * (kCar.inner_radius() + kCar.outer_radius());
  cut.look_at(trial.map, {kCar.half_length, kCar.half_width, radius}, 0.0);
  circle.look_at(trial.map, {0.0, 0.0, radius}, 0.0);
  int freed = 0;
  for (int i = 0; i < 5'000; ++i) {
    const Pose2 pose{random.uniform(0.0, 10.0), random.uniform(0.0, 6.0), random.uniform(-3.1, 3.1)};
    CAPTURE(pose.x, pose.y, pose.yaw);
    const bool whole = touches(trial.grid, kCar, pose);
    if (cut.touched(pose) > 0) REQUIRE((whole && circle.touched(pose) > 0));
    if (whole && cut.touched(pose) == 0) ++freed;
    for (int k = 0; k < 20; ++k) {
      const Vec2 point = radius * random.uniform(0.0, 1.0) * direction(random.uniform(-3.1, 3.1));
      if (std::abs(point.x) > kCar.half_length || std::abs(point.y) > kCar.half_width) continue;
      const Cell cell = trial.map.lattice().cell_at(pose * point);
      if (trial.map.lattice().holds(cell) && trial.map.occupied(cell)) REQUIRE(cut.touched(pose) > 0);
    }
  }
  CHECK(freed > 50);
}

TEST_CASE("a robot that steers drives through a door into the other room, and its outline stays free",
          "[navigation][hybrid]") {
  Trial trial(two_rooms_grid());
  const Pose2 start{1.5, 1.5, std::numbers::pi};
  const SteeredPlan plan = trial.planner.plan(start, {{8.0, 3.0}, -std::numbers::pi / 2.0});
  REQUIRE(plan.complete);
  const Pose2 end = end_of(start, plan);
  CHECK(norm(end.position() - Vec2{8.0, 3.0}) < 1e-6);
  CHECK(std::fabs(wrapped(end.yaw + std::numbers::pi / 2.0)) < 1e-6);
  CHECK(is_free(trial, start, plan));
  for (const WayPiece& piece : plan.pieces) CHECK(std::fabs(piece.curvature) <= 1.0 / kRadius + 1e-9);
}

TEST_CASE("in a corridor in which it cannot turn round it drives backwards rather than stay",
          "[navigation][hybrid]") {
  Trial trial(grid_of(box({0.0, 0.0}, {8.0, 0.8}), {-0.5, -0.5}, {8.5, 1.5}));
  const Pose2 start{6.0, 0.42, 0.0};
  const SteeredPlan plan = trial.planner.plan(start, {{2.0, 0.42}, 0.0});
  REQUIRE(plan.complete);
  CHECK(length_of(plan.pieces) == Approx(4.0).margin(0.1));
  CHECK(plan.pieces.front().length < 0.0);
  CHECK(cusps_of(plan) == 0);
  CHECK(is_free(trial, start, plan));
}

TEST_CASE("the planner says that no way leads into a closed room, and leads as near to it as it can",
          "[navigation][hybrid]") {
  Walls walls = two_rooms();
  walls.push_back({{5.02, 2.4}, {5.02, 3.6}});
  Trial trial(grid_of(walls, {-0.5, -0.5}, {10.5, 6.5}));
  const SteeredPlan plan = trial.planner.plan({1.5, 1.5, 0.0}, {{8.0, 3.0}, std::nullopt});
  CHECK_FALSE(plan.complete);
}

TEST_CASE("a robot whose outline touches something may leave, but never touches more on its way",
          "[navigation][hybrid]") {
  Trial trial(grid_of(box({0.0, 0.0}, {6.0, 6.0}), {-0.5, -0.5}, {6.5, 6.5}));
  const Pose2 start{0.35, 3.0, 0.0};  // its back is in the wall
  REQUIRE(touches(trial.grid, kCar, start));
  const SteeredPlan plan = trial.planner.plan(start, {{4.0, 3.0}, 0.0});
  REQUIRE(plan.complete);
  OutlineGrid outline;
  outline.look_at(trial.map, kCar, 0.0);
  int before = outline.touched(start);
  for (const Pose2& pose : poses_on(start, plan.pieces, 0.005)) {
    CHECK(outline.touched(pose) <= before);
    before = outline.touched(pose);
  }
  CHECK(before == 0);
}
