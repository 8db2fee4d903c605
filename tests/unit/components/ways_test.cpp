// SPDX-License-Identifier: GPL-3.0-or-later
// Ways through topological maps.
#include "orca/planning/ways.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "orca/base/random.hpp"

using namespace orca;
using namespace orca::planning;
using nav::Beam;
using nav::FloorGrid;

namespace {

constexpr double kNoWay = std::numeric_limits<double>::infinity();

/// A topological map with all that driving in it costs.
struct WayTrial {
  Ways ways;
  std::vector<double> from_start, to_goal, points, legs;

  [[nodiscard]] WayTolls tolls() const { return {from_start, to_goal, points, legs}; }
};

// Draws a map of 2 to 7 points and up to 14 legs. Costs are whole numbers, so that sums are exact whatever their order.
WayTrial drawn_trial(RandomStream& random) {
  const auto whole = [&](double most) { return std::floor(random.uniform(0.0, most)); };
  const auto maybe = [&](double share, double cost) {
    return random.uniform(0.0, 1.0) < share ? cost : kNoWay;
  };
  WayTrial trial;
  const auto points = static_cast<std::size_t>(2.0 + whole(6.0));
  for (std::size_t i = 0; i < points; ++i) {
    const bool is_door = random.uniform(0.0, 1.0) < 0.5;
    trial.ways.points.push_back({.name = std::to_string(i),
                                 .place = {},
                                 .door = is_door ? std::optional(Doorway{0.0, 1.0}) : std::nullopt});
    for (int side = 0; side < 2; ++side) {
      trial.from_start.push_back(maybe(0.3, whole(20.0)));
      trial.to_goal.push_back(maybe(0.3, whole(20.0)));
    }
    trial.points.push_back(random.uniform(0.0, 1.0) < 0.2 ? 50.0 : 0.0);
  }
  const double number = whole(15.0);
  for (double i = 0.0; i < number; ++i) {
    const auto from = static_cast<std::size_t>(whole(static_cast<double>(points)));
    const auto to = static_cast<std::size_t>(whole(static_cast<double>(points)));
    const auto side = [&](std::size_t point) {
      return trial.ways.points[point].door && random.uniform(0.0, 1.0) < 0.5 ? std::size_t{1}
                                                                             : std::size_t{0};
    };
    const double cost = 1.0 + whole(20.0);
    const bool one_way = random.uniform(0.0, 1.0) < 0.3;
    trial.ways.legs.push_back({from, to, cost, one_way, side(from), side(to)});
    const double toll = random.uniform(0.0, 1.0);
    trial.legs.push_back(toll < 0.1 ? 50.0 : toll < 0.2 ? kNoWay : 0.0);
  }
  return trial;
}

// Tries all ways that come to no side of a point twice, and returns the least cost. The search finds only ways that it has tried.
class AllWays {
 public:
  explicit AllWays(const WayTrial& trial) : trial_(trial), passed_(2 * trial.ways.points.size()) {}

  double least() {
    for (std::size_t i = 0; i < passed_.size(); ++i)
      if (i % 2 == 0 || is_door(i / 2)) go(i / 2, i % 2, trial_.from_start[i]);
    return least_;
  }

 private:
  [[nodiscard]] bool is_door(std::size_t point) const { return trial_.ways.points[point].door.has_value(); }

  void go(std::size_t point, std::size_t side, double cost) {
    if (passed_[2 * point + side] || cost == kNoWay) return;
    cost += trial_.points[point];
    const std::size_t out = is_door(point) ? 1 - side : 0;
    least_ = std::min(least_, cost + trial_.to_goal[2 * point + out]);
    passed_[2 * point + side] = true;
    for (std::size_t i = 0; i < trial_.ways.legs.size(); ++i) {
      const WayLeg& leg = trial_.ways.legs[i];
      const double on = cost + leg.cost + trial_.legs[i];
      if (leg.from == point && leg.from_side == out) go(leg.to, leg.to_side, on);
      if (leg.to == point && leg.to_side == out && !leg.one_way) go(leg.from, leg.from_side, on);
    }
    passed_[2 * point + side] = false;
  }

  const WayTrial& trial_;
  std::vector<bool> passed_;
  double least_ = kNoWay;
};

// Returns what it costs to drive from point to point of a way, by the cheapest legs. A door may be come to from either side.
double cost_of(const WayTrial& trial, const std::vector<std::size_t>& points) {
  const auto out = [&](std::size_t point, std::size_t side) {
    return trial.ways.points[point].door ? 1 - side : std::size_t{0};
  };
  std::array<double, 2> here{};  // by the side from which it has come to the point
  for (const std::size_t side : {0U, 1U})
    here[side] = trial.from_start[2 * points[0] + side] + trial.points[points[0]];
  if (!trial.ways.points[points[0]].door) here[1] = kNoWay;
  for (std::size_t i = 1; i < points.size(); ++i) {
    std::array<double, 2> next{kNoWay, kNoWay};
    const auto drive = [&](std::size_t from, std::size_t from_side, std::size_t to, std::size_t to_side,
                           double cost) {
      if (from != points[i - 1] || to != points[i]) return;
      for (const std::size_t side : {0U, 1U})
        if (out(from, side) == from_side)
          next[to_side] = std::min(next[to_side], here[side] + cost + trial.points[to]);
    };
    for (std::size_t k = 0; k < trial.ways.legs.size(); ++k) {
      const WayLeg& leg = trial.ways.legs[k];
      drive(leg.from, leg.from_side, leg.to, leg.to_side, leg.cost + trial.legs[k]);
      if (!leg.one_way) drive(leg.to, leg.to_side, leg.from, leg.from_side, leg.cost + trial.legs[k]);
    }
    here = next;
  }
  const std::size_t last = points.back();
  return std::min(here[0] + trial.to_goal[2 * last + out(last, 0)],
                  here[1] + trial.to_goal[2 * last + out(last, 1)]);
}

/// Two rooms of 3 m by 2 m side by side, with a door of 0.8 m in the wall between them at x = 3.05 m, y = 1 m. A cell is occupied if the
/// wall, 0.1 m thick, is somewhere in it.
FloorGrid two_rooms(double side = 0.1) {
  const auto count = [side](double length) { return static_cast<int>(std::ceil(length / side - 1e-9)); };
  FloorGrid grid{{{0.0, 0.0}, side, count(6.1), count(2.0)}, {}};
  for (std::size_t i = 0; i < grid.lattice.size(); ++i) {
    const Vec2 off = grid.lattice.middle_of(grid.lattice.cell_of(i)) - Vec2{3.05, 1.0};
    const bool is_wall = std::fabs(off.x) < 0.5 * side + 0.05 - 1e-9;
    const bool is_door = std::fabs(off.y) < 0.4 - 0.5 * side + 1e-9;
    grid.cells.push_back(is_wall && !is_door ? FloorGrid::kMost : std::uint8_t{0});
  }
  return grid;
}

Ways two_rooms_ways() {
  return {"rooms",
          {{.name = "west", .place = {1.0, 1.0}},
           {.name = "door", .place = {3.05, 1.0}, .door = Doorway{0.0, 0.8}},
           {.name = "east", .place = {5.0, 1.0}}},
          {{0, 1, 2.05, false, 0, 0}, {1, 2, 1.95, false, 1, 0}}};
}

}  // namespace

TEST_CASE("the legs of 1,000 drawn topological maps cost what the best of all ways does", "[ways]") {
  RandomStream random(1, "ways", "maps");
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    const WayTrial trial = drawn_trial(random);
    const double least = AllWays(trial).least();
    const auto way = cheapest_way(trial.ways, trial.tolls());
    CAPTURE(i, least);
    REQUIRE(way.has_value() == (least < kNoWay));
    if (!way) continue;
    ++found;
    REQUIRE(way->cost == least);
    REQUIRE(cost_of(trial, way->points) == least);
    double sum = 0.0;
    for (const double cost : way->costs) sum += cost;
    REQUIRE(sum <= least);  // The rest is the way from the last point to the goal.
  }
  CHECK(found > 300);  // The maps are worth the search.
  CHECK(found < 1000);
}

TEST_CASE("of equally cheap ways it is the one with fewer places", "[ways]") {
  const Ways ways{"w", {{"a", {}}, {"b", {}}, {"c", {}}}, {{0, 1, 1.0}, {1, 2, 1.0}, {0, 2, 2.0}}};
  const std::vector<double> start{0.0, kNoWay, kNoWay, kNoWay, kNoWay, kNoWay};
  const std::vector<double> goal{kNoWay, kNoWay, kNoWay, kNoWay, 0.0, kNoWay};
  const std::vector<double> none(3, 0.0);
  const auto way = cheapest_way(ways, {start, goal, none, none});
  REQUIRE(way);
  CHECK(way->points == std::vector<std::size_t>{0, 2});
  CHECK(way->costs == std::vector<double>{0.0, 2.0});
}

TEST_CASE("a way goes through a door, never back on the side where it came", "[ways]") {
  Ways ways = two_rooms_ways();
  ways.points.push_back({.name = "beside", .place = {1.0, 1.5}});
  ways.legs.push_back({1, 3, 1.0, false, 0, 0});
  const std::vector<double> start{0.0, kNoWay, kNoWay, kNoWay, kNoWay, kNoWay, kNoWay, kNoWay};
  const std::vector<double> none(4, 0.0);
  std::vector<double> goal(8, kNoWay);
  goal[2 * 2] = 0.0;
  CHECK(cheapest_way(ways, {start, goal, none, none})->points == std::vector<std::size_t>{0, 1, 2});
  ways.legs.erase(ways.legs.begin() + 1);  // There it could turn round.
  goal.assign(8, kNoWay);
  goal[2 * 3] = 0.0;
  CHECK_FALSE(cheapest_way(ways, {start, goal, none, none}));
}

TEST_CASE("a place costs what the way to it is long, and none leads through a door", "[ways]") {
  const auto costs = costs_from(two_rooms(), two_rooms_ways(), {0.5, 1.0});
  CHECK(costs[0] == Approx(0.5).margin(0.35));  // to within the cells around it
  CHECK(costs[2] == Approx(2.55).margin(0.35));
  CHECK(costs[3] == kNoWay);  // the door's other side
  CHECK(costs[4] == kNoWay);
}

TEST_CASE("cells may be large: no way leads through a door by cells that lie on both of its sides",
          "[ways]") {
  for (const double side : {0.05, 0.1, 0.17, 0.2, 0.25, 0.33}) {
    CAPTURE(side);
    const auto costs = costs_from(two_rooms(side), two_rooms_ways(), {0.5, 1.0});
    CHECK(costs[0] == Approx(0.5).margin(0.1 + 1.5 * side));
    CHECK(costs[2] == Approx(2.55).margin(0.1 + 2.5 * side));
    CHECK(costs[3] == kNoWay);
    CHECK(costs[4] == kNoWay);
    const auto back = costs_from(two_rooms(side), two_rooms_ways(), {5.5, 1.0});
    CHECK(back[2] == kNoWay);
    CHECK(back[3] == Approx(2.45).margin(0.1 + 2.5 * side));
  }
}

TEST_CASE("a robot in a doorway gets to both sides", "[ways]") {
  const auto costs = costs_from(two_rooms(), two_rooms_ways(), {3.0, 1.0});
  CHECK(costs[0] == Approx(2.0).margin(0.35));
  CHECK(costs[2] == Approx(0.05));
  CHECK(costs[3] == Approx(0.05));
  CHECK(costs[4] == Approx(2.0).margin(0.35));
}

TEST_CASE("a robot that touches a wall, or stands where nothing is known, is somewhere", "[ways]") {
  CHECK(costs_from(two_rooms(), two_rooms_ways(), {0.05, 0.05})[0] < 2.0);
  CHECK(costs_from(two_rooms(), two_rooms_ways(), {-1.0, 0.0})[0] == kNoWay);
}

namespace {

// A door of 0.8 m in a wall along y at x = 2, that leads along x.
const WayPoint kDoorOfWall{.name = "door", .place = {2.0, 0.0}, .door = Doorway{0.0, 0.8}};

// A fan of beams from a place, one per degree, in a wall with a doorway; `shut` says how much of the opening a leaf covers [m].
std::vector<Beam> fan(Vec2 from, double shut) {
  std::vector<Beam> beams;
  for (int degrees = -89; degrees < 90; ++degrees) {
    const Vec2 ahead = direction(degrees * std::numbers::pi / 180.0);
    const double range = (2.0 - from.x) / ahead.x;
    const double across = from.y + range * ahead.y;
    const bool is_opening = std::fabs(across) < 0.4 && across > -0.4 + shut;
    if (range > 5.0) continue;
    beams.push_back({from, from + (is_opening ? 5.0 : range) * ahead, !is_opening});
  }
  return beams;
}

std::optional<bool> seen_open(Vec2 from, double shut) {
  return look_at(kDoorOfWall, fan(from, shut)).is_open(kDoorOfWall.door->width);
}

}  // namespace

TEST_CASE("a door is open if most beams lead through it, and shut if they end in it", "[ways]") {
  CHECK(seen_open({0.0, 0.0}, 0.0) == true);
  CHECK(seen_open({0.0, 0.0}, 0.8) == false);
  CHECK(seen_open({0.0, 0.0}, 0.6) == false);
  CHECK(seen_open({0.0, 0.0}, 0.5) == false);
  CHECK(seen_open({0.0, 0.0}, 0.2) == true);
  CHECK(seen_open({0.0, 2.0}, 0.8) == false);  // obliquely
}

TEST_CASE("a door that is too far aside or not in view is not judged", "[ways]") {
  CHECK_FALSE(seen_open({1.5, 3.0}, 0.8));
  std::vector<Beam> beams = fan({0.0, 0.0}, 0.8);
  for (Beam& beam : beams) beam.to = 0.5 * beam.to;  // Somebody stands before it.
  CHECK_FALSE(look_at(kDoorOfWall, beams).is_open(0.8));
  CHECK_FALSE(look_at(kDoorOfWall, {}).is_open(0.8));
}
