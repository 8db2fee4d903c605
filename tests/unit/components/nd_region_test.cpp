// SPDX-License-Identifier: GPL-3.0-or-later
// Where ND+ goes on: the free walking area (see region.hpp).
#include "nd_plus/region.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/base/random.hpp"

using namespace orca::nd;
using orca::Vec2;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRadius = 0.3;  // [m]
constexpr Goal kAhead{0.0, 5.0};

using Openings = std::vector<std::pair<double, double>>;  // [m] from y = right to y = left

// A wall `distance` [m] ahead that is closed to both sides, with openings.
std::vector<Vec2> wall_with(const Openings& openings, double distance = 1.0) {
  std::vector<Vec2> echoes;
  for (int i = -80; i <= 80; ++i) {
    const double y = 0.05 * i;
    const auto is_open = [&](const auto& opening) {
      return y > opening.first + 1e-9 && y < opening.second - 1e-9;
    };
    if (std::ranges::none_of(openings, is_open)) echoes.push_back({distance, y});
  }
  return echoes;
}

double angle(Vec2 place) { return orca::portable::atan2(place.y, place.x); }

}  // namespace

TEST_CASE("a circle passes between two posts if it is not wider than what lies between them", "[nd]") {
  const Vec2 behind{2.0, 0.0};
  CHECK(is_navigable(std::vector<Vec2>{{1.0, 0.31}, {1.0, -0.31}}, behind, kRadius));
  CHECK_FALSE(is_navigable(std::vector<Vec2>{{1.0, 0.29}, {1.0, -0.29}}, behind, kRadius));
  CHECK_FALSE(is_navigable(std::vector<Vec2>{{1.0, 0.4}, {1.3, -0.05}}, behind, kRadius));
}

TEST_CASE("what stands on one side of the way, behind the place or behind the robot does not close it",
          "[nd]") {
  const Vec2 place{1.0, 0.0};
  CHECK(is_navigable(std::vector<Vec2>{{0.5, 0.0}, {0.5, 0.2}}, place, kRadius));
  CHECK(is_navigable(std::vector<Vec2>{{1.35, 0.1}, {1.35, -0.1}}, place, kRadius));
  CHECK(is_navigable(std::vector<Vec2>{{-0.35, 0.1}, {-0.35, -0.1}}, place, kRadius));
}

TEST_CASE("a place where the circle finds no room is not navigable", "[nd]") {
  CHECK_FALSE(is_navigable(std::vector<Vec2>{{1.2, 0.1}}, {1.0, 0.0}, kRadius));
}

TEST_CASE("the area holds the goal if the goal is seen and can be reached", "[nd]") {
  const auto open = free_walking_area({}, {0.5, 3.0}, kRadius);
  REQUIRE(open);
  CHECK(open->holds_goal());
  CHECK(angle(open->place) == Approx(0.5));
  CHECK(open->region.width == kSectors);
  const auto through_a_door = free_walking_area(wall_with({{-0.5, 0.5}}), kAhead, kRadius);
  REQUIRE(through_a_door);
  CHECK(through_a_door->holds_goal());
  CHECK(through_a_door->region.width < kSectors / 3);
}

TEST_CASE("a goal in front of a wall has a region of its own, one behind it is not seen", "[nd]") {
  const auto before = free_walking_area(wall_with({}, 2.0), {0.0, 1.5}, kRadius);
  REQUIRE(before);
  CHECK(before->holds_goal());
  const auto behind = free_walking_area(wall_with({}, 2.0), {0.0, 3.0}, kRadius);
  REQUIRE(behind);
  CHECK_FALSE(behind->holds_goal());
}

TEST_CASE("of two ways out that with the gap nearest to the goal is chosen", "[nd]") {
  const std::vector<Vec2> two_doors = wall_with({{0.4, 1.4}, {-1.6, -0.6}});
  const auto left = free_walking_area(two_doors, kAhead, kRadius);
  REQUIRE(left);
  REQUIRE(left->edge);
  CHECK(left->edge->place.y == Approx(0.4).margin(0.1));
  CHECK(left->edge->side == -1.0);
  CHECK(angle(left->place) > angle(left->edge->place));
  const auto right = free_walking_area(two_doors, {-0.4, 5.0}, kRadius);
  REQUIRE(right);
  REQUIRE(right->edge);
  CHECK(right->edge->place.y == Approx(-0.6).margin(0.1));
  CHECK(right->edge->side == 1.0);
}

TEST_CASE("the gap to which the robot went is kept, unless another one is much nearer to the goal", "[nd]") {
  const std::vector<Vec2> two_doors = wall_with({{0.4, 1.4}, {-1.6, -0.6}});
  const auto side_of_edge = [&](const Goal& goal) {
    const auto area = free_walking_area(two_doors, goal, kRadius);
    REQUIRE(area);
    REQUIRE(area->edge);
    return area->edge->place.y > 0.0 ? "left" : "right";
  };
  CHECK(side_of_edge({0.0, 5.0, 0.5}) == std::string("left"));
  CHECK(side_of_edge({0.0, 5.0, -0.7}) == std::string("right"));
  CHECK(side_of_edge({0.37, 5.0, -0.7}) == std::string("left"));
}

TEST_CASE("a region that is too narrow for the robot is not navigable: the next one is taken", "[nd]") {
  const auto area = free_walking_area(wall_with({{0.2, 0.7}, {-1.7, -0.7}}), kAhead, kRadius);
  REQUIRE(area);
  REQUIRE(area->edge);
  CHECK(area->edge->place.y == Approx(-0.7).margin(0.1));
  const auto narrower = free_walking_area(wall_with({{0.2, 0.7}, {-1.7, -0.7}}), kAhead, 0.2);
  REQUIRE(narrower);
  REQUIRE(narrower->edge);
  CHECK(narrower->edge->place.y == Approx(0.2).margin(0.1));
}

TEST_CASE("the robot goes past an edge at a distance of its radius, where it finds room", "[nd]") {
  const auto area = free_walking_area(wall_with({{0.4, 2.0}}), kAhead, kRadius);
  REQUIRE(area);
  REQUIRE(area->edge);
  CHECK(norm(area->place - area->edge->place) == Approx(kRadius));
}

TEST_CASE("in a closed room there is no free walking area", "[nd]") {
  std::vector<Vec2> echoes;
  for (int i = 0; i < 72; ++i) echoes.push_back(orca::direction(i * kPi / 36));
  CHECK_FALSE(free_walking_area(echoes, kAhead, kRadius));
}

TEST_CASE("a mirrored scene has the mirrored free walking area", "[nd]") {
  orca::RandomStream random(2, "test", "nd");
  for (int i = 0; i < 200; ++i) {
    std::vector<Vec2> echoes;
    std::vector<Vec2> mirrored;
    for (int j = 0; j < 15; ++j) {
      const Vec2 echo = random.uniform(0.6, 2.0) * orca::direction(random.uniform(-kPi, kPi));
      echoes.push_back(echo);
      mirrored.push_back({echo.x, -echo.y});
    }
    const double goal = random.uniform(-1.0, 1.0);
    const auto one = free_walking_area(echoes, {goal, 5.0}, kRadius);
    const auto other = free_walking_area(mirrored, {-goal, 5.0}, kRadius);
    REQUIRE(one.has_value() == other.has_value());
    if (!one) continue;
    CHECK(one->holds_goal() == other->holds_goal());
    CHECK(one->place.x == Approx(other->place.x).margin(1e-12));
    CHECK(one->place.y == Approx(-other->place.y).margin(1e-12));
  }
}

TEST_CASE("an area that is seen from farther on is where it was", "[nd]") {
  const auto echoes = wall_with({{1.0, 2.5}});
  const auto area = free_walking_area(echoes, kAhead, kRadius);
  REQUIRE(area);
  REQUIRE(area->edge);
  const orca::Pose2 on{0.2, -0.1, 4 * kSector};
  const FreeWalkingArea seen = seen_from(on, *area);
  CHECK(norm(on * seen.place - area->place) == Approx(0.0).margin(1e-12));
  CHECK(norm(on * seen.edge->place - area->edge->place) == Approx(0.0).margin(1e-12));
  CHECK(seen.region.middle() + on.yaw == Approx(area->region.middle()));
  CHECK(seen.region.width == area->region.width);
}
