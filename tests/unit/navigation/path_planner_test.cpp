// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/path_planner.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "orca/base/random.hpp"

using namespace orca::nav;
using orca::Vec2;

namespace {

constexpr Footprint kJackal{0.254, 0.215, 0.333};

void put_wall(std::vector<Beam>& scan, Vec2 from, Vec2 to) {
  const int pieces = static_cast<int>(norm(to - from) / 0.02) + 1;
  for (int i = 0; i <= pieces; ++i) {
    const Vec2 place = from + (static_cast<double>(i) / pieces) * (to - from);
    scan.push_back({place, place, true});
  }
}

OccupancyMap map_with(const std::vector<Beam>& scan) {
  OccupancyMap map(0.05, 12.0);
  map.reset({});
  map.see(scan);
  map.see(scan);
  return map;
}

OccupancyMap random_posts(orca::RandomStream& random) {
  std::vector<Beam> scan;
  for (int i = 0; i < 60; ++i) {
    const Vec2 post{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0)};
    if (norm(post) > 0.6) put_wall(scan, post, post + Vec2{0.1, 0.0});
  }
  return map_with(scan);
}

constexpr double kCellError = 0.05;  // [m] by which the middle of a cell misleads

// Returns how far the nearest echo of a map is from a place.
double room_at(const OccupancyMap& map, Vec2 place) {
  double least = 1.0;
  map.for_points_near(place, 1.0, [&](Vec2 point) { least = std::min(least, norm(point - place)); });
  return least;
}

}  // namespace

TEST_CASE("in the open the path is the straight line to the goal", "[navigation]") {
  PathPlanner planner;
  const OccupancyMap map = map_with({});
  planner.look_at(map, kJackal, {});
  const Plan plan = planner.plan(map, {-1.0, -2.0}, {4.0, 1.0});
  CHECK(plan.complete);
  CHECK(plan.path.at(0.0) == Vec2{-1.0, -2.0});
  CHECK(plan.path.at(plan.path.length()) == Vec2{4.0, 1.0});
  CHECK(plan.path.length() < 1.02 * norm(Vec2{5.0, 3.0}));
}

TEST_CASE("out of a U the path leads back and round it", "[navigation]") {
  std::vector<Beam> scan;
  put_wall(scan, {2.0, -1.0}, {2.0, 1.0});
  put_wall(scan, {0.0, 1.0}, {2.0, 1.0});
  put_wall(scan, {0.0, -1.0}, {2.0, -1.0});
  const OccupancyMap map = map_with(scan);
  PathPlanner planner;
  planner.look_at(map, kJackal, {});
  const Plan plan = planner.plan(map, {1.5, 0.0}, {4.0, 0.0});
  CHECK(plan.complete);
  CHECK(plan.path.length() > 5.0);
  CHECK(touches_along(map, kJackal, plan.path, 0.0, plan.path.length()) < 0.0);
}

TEST_CASE("no path that is called complete makes the outline touch anything on its first 3 m",
          "[navigation]") {
  orca::RandomStream random(13, "test", "posts");
  PathPlanner planner;
  int complete = 0;
  for (int i = 0; i < 60; ++i) {
    const OccupancyMap map = random_posts(random);
    planner.look_at(map, kJackal, {});
    const Plan plan = planner.plan(map, {}, {random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0)});
    if (!plan.complete) continue;
    ++complete;
    CAPTURE(i);
    CHECK(touches_along(map, kJackal, plan.path, 0.25, 3.0) < 0.0);
    CHECK(planner.cost_of(map, plan.path, 0.0) < kImpassable);
  }
  CHECK(complete > 25);
}

TEST_CASE("a door is passed if the robot fits through, and not if it does not", "[navigation]") {
  for (const double spare : {0.1, 0.3, -0.06}) {
    std::vector<Beam> scan;
    const double half = kJackal.half_width + 0.5 * spare;
    put_wall(scan, {1.0, half}, {1.0, 6.0});
    put_wall(scan, {1.0, -half}, {1.0, -6.0});
    const OccupancyMap map = map_with(scan);
    PathPlanner planner;
    planner.look_at(map, kJackal, {});
    CAPTURE(spare);
    CHECK(planner.plan(map, {-1.0, -1.5}, {3.0, 1.0}).complete == (spare > 0.0));
  }
}

TEST_CASE("a goal beyond the map gives a path towards it, which is not complete", "[navigation]") {
  const OccupancyMap map = map_with({});
  PathPlanner planner;
  planner.look_at(map, kJackal, {});
  const Plan plan = planner.plan(map, {}, {40.0, 0.0});
  CHECK_FALSE(plan.complete);
  CHECK(plan.path.at(plan.path.length()).x > 5.5);
  CHECK(std::abs(plan.path.at(plan.path.length()).y) < 0.1);
}

TEST_CASE("a robot that stands too near to a wall finds a way from it", "[navigation]") {
  std::vector<Beam> scan;
  put_wall(scan, {0.15, -3.0}, {0.15, 3.0});
  const OccupancyMap map = map_with(scan);
  PathPlanner planner;
  planner.look_at(map, kJackal, {});
  CHECK(planner.plan(map, {}, {-3.0, 0.0}).complete);
}

TEST_CASE("from a place that is too near to something the path leads away, and never nearer to anything",
          "[navigation]") {
  orca::RandomStream random(8, "test", "places");
  PathPlanner planner;
  int left = 0;
  OccupancyMap map = random_posts(random);
  for (int i = 0; i < 3000; ++i) {
    if (i % 50 == 0) map = random_posts(random);
    const Vec2 start{random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0)};
    const double room = room_at(map, start);
    if (room > kJackal.inner_radius() - 0.06 || room < 0.08) continue;
    planner.look_at(map, kJackal, {});
    const Plan plan = planner.plan(map, start, {random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0)});
    CAPTURE(i, start.x, start.y, room);
    double most = room;
    for (double along = 0.0; along < plan.path.length() && most < kJackal.inner_radius(); along += 0.02) {
      const double now = room_at(map, plan.path.at(along));
      CHECK(now > most - kCellError);
      most = std::max(most, now);
    }
    left += most >= kJackal.inner_radius() ? 1 : 0;
  }
  CHECK(left > 30);
}
