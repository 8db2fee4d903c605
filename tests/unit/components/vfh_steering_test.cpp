// SPDX-License-Identifier: GPL-3.0-or-later
// The fourth stage of VFH+, equations 12 to 16 of the paper (see histogram.hpp), and whole laps.
#include "vfh_plus/steering.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/angle.hpp"

using namespace orca::vfh;
using std::numbers::pi;

namespace {

constexpr double kDegree = pi / 180;
constexpr double kWide = 80 * kDegree;
constexpr Costs kCosts{};
const Settings kSettings{.around = {.radius = 0.4, .window = 1.2, .near_weight = 5.0},
                         .thresholds = {.low = 1.5, .high = 2.5},
                         .wide = kWide,
                         .costs = kCosts};
constexpr Motion kStill{};

// Returns a histogram in which only `count` sectors from `first` on are free, counted to the left.
Blocked all_but(std::size_t first, std::size_t count) {
  Blocked blocked;
  blocked.set();
  for (std::size_t i = 0; i < count; ++i) blocked.reset((first + i) % kSectors);
  return blocked;
}

// Returns a histogram in which the directions within `degrees` of a direction are blocked.
Blocked blocked_around(double middle, double degrees) {
  Blocked blocked;
  for (std::size_t k = 0; k < kSectors; ++k)
    blocked[k] = apart(static_cast<double>(k) * kSector, middle * kDegree) <= degrees * kDegree + 1e-9;
  return blocked;
}

// A wall across the way ahead, symmetric to it.
std::vector<Cell> wall(double distance, double half_width) {
  std::vector<Cell> cells;
  for (double y = -half_width; y <= half_width + 1e-9; y += 0.1) cells.push_back({{distance, y}, 1.0});
  return cells;
}

std::vector<Cell> ring(double distance) {
  std::vector<Cell> cells;
  for (int i = 0; i < 36; ++i) cells.push_back({distance * orca::direction(10 * i * kDegree), 1.0});
  return cells;
}

std::optional<Choice> first_lap(const std::vector<Cell>& cells, const Motion& motion, double target) {
  State state;
  return steer(cells, motion, target, kSettings, state);
}

}  // namespace

TEST_CASE("angles are compared the shorter way round", "[vfh]") {
  CHECK(apart(170 * kDegree, -170 * kDegree) == Approx(20 * kDegree));
  CHECK(apart(-5 * kDegree, 725 * kDegree) == Approx(10 * kDegree));
  CHECK(apart(pi, -pi) == Approx(0.0).margin(1e-12));
}

TEST_CASE("valleys are the runs of free sectors, across the seam too", "[vfh]") {
  const std::vector<Valley> one = valleys(all_but(70, 5));
  REQUIRE(one.size() == 1);
  CHECK(one[0].right == 70);
  CHECK(one[0].width == 5);
  const std::vector<Valley> two = valleys(all_but(70, 5) & all_but(10, 3));
  REQUIRE(two.size() == 2);
  CHECK(two[0].right == 10);
  CHECK(two[0].width == 3);
  CHECK(two[1].right == 70);
  CHECK(two[1].width == 5);
}

TEST_CASE("where nothing is blocked there is one valley, and none where all is", "[vfh]") {
  REQUIRE(valleys({}).size() == 1);
  CHECK(valleys({})[0].width == kSectors);
  CHECK(valleys(Blocked{}.set()).empty());
}

TEST_CASE("a narrow valley offers its middle", "[vfh]") {
  for (const double target : {0.0, 15 * kDegree, 3.0}) {
    const std::vector<double> offered = candidates({.right = 2, .width = 5}, target, kWide);
    REQUIRE(offered.size() == 1);
    CHECK(offered[0] == Approx(20 * kDegree));  // from 10 to 30 degrees
  }
}

TEST_CASE("a wide valley offers a direction well inside either border, and the goal if it lies between these",
          "[vfh]") {
  const Valley valley{.right = 70, .width = 25};  // from -10 to 110 degrees
  const std::vector<double> without = candidates(valley, -2.0, kWide);
  REQUIRE(without.size() == 2);
  CHECK(apart(without[0], 30 * kDegree) < 1e-9);
  CHECK(apart(without[1], 70 * kDegree) < 1e-9);
  const std::vector<double> with = candidates(valley, 50 * kDegree, kWide);
  REQUIRE(with.size() == 3);
  CHECK(with[2] == 50 * kDegree);
  CHECK(candidates(valley, 20 * kDegree, kWide).size() == 2);  // free, but too near to the border
}

TEST_CASE("a valley of just the limiting width is narrow, one sector more makes it wide", "[vfh]") {
  CHECK(candidates({.right = 0, .width = 17}, 3.0, kWide + 1e-9).size() == 1);
  CHECK(candidates({.right = 0, .width = 18}, 3.0, kWide + 1e-9).size() == 2);
}

TEST_CASE("the cost is the weighted sum of the angles to the goal, the heading and the last direction",
          "[vfh]") {
  const Aim aim{.target = 1.0, .heading = -0.5, .last = 0.25};
  CHECK(cost(0.5, aim, {.target = 5.0, .heading = 2.0, .last = 3.0}) == Approx(5 * 0.5 + 2 * 1.0 + 3 * 0.25));
  CHECK(cost(0.5, {.target = 1.0, .heading = -0.5, .last = {}}, kCosts) == Approx(5 * 0.5 + 2 * 1.0));
}

TEST_CASE("the side of the goal is preferred", "[vfh]") {
  const Blocked ahead = blocked_around(0, 40);
  CHECK(*cheapest(ahead, {.target = 0.3, .heading = 0.0, .last = {}}, kWide, kCosts) > 0.0);
  CHECK(orca::wrapped(*cheapest(ahead, {.target = -0.3, .heading = 0.0, .last = {}}, kWide, kCosts)) < 0.0);
}

TEST_CASE("a goal that outweighs heading and last direction together wins, a lighter one does not", "[vfh]") {
  const Blocked ahead = blocked_around(0, 40);
  const Aim aim{.target = 90 * kDegree, .heading = -90 * kDegree, .last = -90 * kDegree};
  CHECK(apart(*cheapest(ahead, aim, kWide, {5.0, 2.0, 2.0}), aim.target) < 1e-9);
  CHECK(apart(*cheapest(ahead, aim, kWide, {3.0, 2.0, 2.0}), aim.heading) < 20 * kDegree);
}

TEST_CASE("with nothing in the way the robot goes to the goal", "[vfh]") {
  for (const double target : {0.0, 0.31, -3.0}) {
    const auto choice = first_lap({}, {.heading = 1.0, .radius = 0.4}, target);
    REQUIRE(choice);
    CHECK(choice->direction == target);
    CHECK_FALSE(choice->at_rest);
  }
}

TEST_CASE("a wall ahead is passed well aside, past the robot's own width", "[vfh]") {
  const auto choice = first_lap(wall(0.7, 0.3), kStill, 0.1);
  REQUIRE(choice);
  const double edge = std::atan2(0.3, 0.7) + enlargement(std::hypot(0.3, 0.7), 0.4);
  CHECK(choice->direction > edge);
  CHECK(choice->direction < pi / 2 + edge);
}

TEST_CASE("a door that the robot fits through is passed in its middle", "[vfh]") {
  std::vector<Cell> posts;
  for (double y = 0.5; y <= 1.5; y += 0.1) {
    posts.push_back({{0.4, y}, 1.0});
    posts.push_back({{0.4, -y}, 1.0});
  }
  const auto choice = first_lap(posts, kStill, 0.2);
  REQUIRE(choice);
  CHECK(apart(choice->direction, 0.0) < 1e-9);
}

TEST_CASE("in front of something symmetric the robot does not dither, whatever noise there is", "[vfh]") {
  orca::RandomStream random(4, "test", "noise");
  State state;
  double last = 0.0;
  for (int i = 0; i < 300; ++i) {
    std::vector<Cell> cells = wall(0.7, 0.3);
    for (Cell& cell : cells) cell.place = cell.place + orca::Vec2{0.0, random.normal(0.0, 0.02)};
    const auto choice = steer(cells, kStill, 0.0, kSettings, state);
    REQUIRE(choice);
    const double direction = orca::wrapped(choice->direction);
    CHECK(direction * last >= 0.0);
    last = direction;
  }
  CHECK(std::abs(last) > 0.5);
}

TEST_CASE("a direction that was blocked stays blocked a little longer, one that was free stays free",
          "[vfh]") {
  const std::vector<Cell> between{{{1.03, 0.0}, 1.0}};  // magnitude 2.05
  const std::vector<Cell> nearer{{{0.8, 0.0}, 1.0}};
  State state;
  CHECK(steer(between, kStill, 0.0, kSettings, state)->direction == 0.0);
  CHECK(apart(steer(nearer, kStill, 0.0, kSettings, state)->direction, 0.0) > 0.5);
  CHECK(apart(steer(between, kStill, 0.0, kSettings, state)->direction, 0.0) > 0.5);
  CHECK(steer({}, kStill, 0.0, kSettings, state)->direction == 0.0);
}

TEST_CASE("where no direction is free the robot is to stop, and it remembers where it wanted to go",
          "[vfh]") {
  State state;
  state.last = 1.0;
  CHECK_FALSE(steer(ring(0.7), kStill, 0.0, kSettings, state));
  CHECK(state.last == 1.0);
}

TEST_CASE("where only its speed keeps the robot from turning away it is to stop and turn", "[vfh]") {
  const Motion fast{.heading = 0.0, .radius = 2.0};
  const auto choice = first_lap(wall(0.6, 0.6), fast, 0.1);
  REQUIRE(choice);
  CHECK(choice->at_rest);
  const auto slow = first_lap(wall(0.6, 0.6), kStill, 0.1);
  REQUIRE(slow);
  CHECK_FALSE(slow->at_rest);
  CHECK(slow->direction == choice->direction);
}

TEST_CASE("in a mirrored world the robot goes the mirrored way", "[vfh]") {
  orca::RandomStream random(5, "test", "mirror");
  for (int i = 0; i < 300; ++i) {
    std::vector<Cell> cells(random() % 9);
    for (Cell& cell : cells)
      cell = {random.uniform(0.2, 1.3) * orca::direction(random.uniform(-pi, pi)), random.uniform(0.5, 1.0)};
    const double target = random.uniform(-3.0, 3.0);
    const Motion motion{0.0, random.uniform(0.0, 0.5)};
    const auto choice = first_lap(cells, motion, target);
    for (Cell& cell : cells) cell.place.y = -cell.place.y;
    const auto mirrored = first_lap(cells, motion, -target);
    REQUIRE(mirrored.has_value() == choice.has_value());
    if (!choice) continue;
    CHECK(std::abs(orca::wrapped(mirrored->direction + choice->direction)) < 1e-9);
    CHECK(mirrored->at_rest == choice->at_rest);
  }
}
