// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/floor_rules.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "grids.hpp"
#include "orca/navigation/hybrid_planner.hpp"
#include "orca/navigation/path_planner.hpp"
#include "steered_ways.hpp"

using namespace orca;
using namespace orca::nav;
using namespace orca::test;
using Kind = FloorZone::Kind;

namespace {

constexpr Footprint kRobot{0.25, 0.2, 0.35};

/// Two planners on a floor with rules.
struct Trial {
  Trial(FloorGrid floor, FloorRules zones) : map(floor), rules(std::move(zones)) {}

  Plan plan(Vec2 from, Vec2 to) {
    planner.look_at(map, kRobot, {});
    planner.obey(map.lattice(), rules, from);
    return planner.plan(map, from, to);
  }
  std::vector<Vec2> steered(const Pose2& from, Vec2 to) {
    planner.look_at(map, kRobot, {});
    planner.obey(map.lattice(), rules, from.position());
    HybridPlanner hybrid;
    hybrid.look_at(map, kRobot, planner.costs(), planner.forbidden(), 0.5, 0.02);
    const SteeredPlan plan = hybrid.plan(from, {to, std::nullopt});
    REQUIRE(plan.complete);
    std::vector<Vec2> places;
    for (const Pose2& pose : poses_on(from, plan.pieces, 0.05)) places.push_back(pose.position());
    return places;
  }

  OccupancyMap map;
  FloorRules rules;
  PathPlanner planner{kShortest};
};

FloorGrid hall() { return grid_of(box({0.0, 0.0}, {10.0, 6.0}), {-0.5, -0.5}, {10.5, 6.5}); }

// Returns the length of the path that lies in a zone and leads against its x axis.
double against(const std::vector<Vec2>& path, const FloorZone& zone) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 way = path[i] - path[i - 1];
    if (zone.holds(path[i]) && dot(way, direction(zone.middle.yaw)) < -0.3 * norm(way)) length += norm(way);
  }
  return length;
}

double within(const std::vector<Vec2>& path, const FloorZone& zone) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i)
    if (zone.holds(path[i])) length += norm(path[i] - path[i - 1]);
  return length;
}

}  // namespace

TEST_CASE("no path leads into a zone to keep out of, and one leads out of it", "[navigation][rules]") {
  const FloorZone zone{Kind::keep_out, "glass", {5.0, 3.0, 0.0}, 1.0, 2.0, 0.0, false};
  Trial trial(hall(), FloorRules({zone}));
  const Plan around = trial.plan({1.0, 3.0}, {9.0, 3.0});
  CHECK(around.complete);
  CHECK(within(around.path.points(), zone) == 0.0);
  CHECK(within(trial.steered({1.0, 3.0, 0.0}, {9.0, 3.0}), zone) == 0.0);
  CHECK(trial.plan({5.0, 3.0}, {9.0, 3.0}).complete);
  CHECK_FALSE(trial.plan({1.0, 3.0}, {5.0, 3.0}).complete);
}

TEST_CASE("a path avoids a slow zone if the detour takes less time", "[navigation][rules]") {
  const FloorZone zone{Kind::slow, "people", {5.0, 2.0, 0.0}, 2.0, 1.9, 0.1, false};
  Trial trial(hall(), FloorRules({zone}));
  CHECK(within(trial.plan({1.0, 3.0}, {9.0, 3.0}).path.points(), zone) < 0.3);
  CHECK(trial.rules.speed_at({5.0, 2.0}) == 0.1);
  CHECK_FALSE(trial.rules.speed_at({8.0, 2.0}));
}

TEST_CASE("robots keep to lanes, and drive none against its direction", "[navigation][rules]") {
  const double pi = std::numbers::pi;
  const FloorZone east{Kind::lane, "east", {5.0, 2.6, 0.0}, 4.5, 0.35, 0.0, true};
  const FloorZone west{Kind::lane, "west", {5.0, 3.4, pi}, 4.5, 0.35, 0.0, true};
  Trial trial(hall(), FloorRules({east, west}));
  const Plan there = trial.plan({1.0, 3.0}, {9.0, 3.0});
  const Plan back = trial.plan({9.0, 3.0}, {1.0, 3.0});
  CHECK(there.complete);
  CHECK(back.complete);
  CHECK(within(there.path.points(), east) > 6.0);
  CHECK(within(back.path.points(), west) > 6.0);
  CHECK(against(there.path.points(), west) == 0.0);
  CHECK(against(back.path.points(), east) == 0.0);
  CHECK(against(trial.steered({1.0, 3.0, 0.0}, {9.0, 3.0}), west) == 0.0);
  CHECK(against(trial.steered({9.0, 3.0, pi}, {1.0, 3.0}), east) == 0.0);
}

TEST_CASE("a lane on the other side of the corridor is crossed", "[navigation][rules]") {
  const double pi = std::numbers::pi;
  const FloorZone east{Kind::lane, "east", {5.0, 2.6, 0.0}, 4.5, 0.35, 0.0, true};
  const FloorZone west{Kind::lane, "west", {5.0, 3.4, pi}, 4.5, 0.35, 0.0, true};
  Walls walls = box({0.0, 0.0}, {10.0, 6.0});
  for (const Walls& more : {Walls{{{0.0, 4.0}, {2.0, 4.0}}, {{3.0, 4.0}, {10.0, 4.0}}},
                            Walls{{{0.0, 2.0}, {7.0, 2.0}}, {{8.0, 2.0}, {10.0, 2.0}}}})
    walls.insert(walls.end(), more.begin(), more.end());
  Trial trial(grid_of(walls, {-0.5, -0.5}, {10.5, 6.5}), FloorRules({east, west}));
  const Plan plan = trial.plan({2.5, 5.0}, {7.5, 1.0});
  CHECK(plan.complete);
  CHECK(against(plan.path.points(), west) == 0.0);
}
