// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>

#include "grids.hpp"
#include "orca/navigation/map_localizer.hpp"
#include "orca/navigation/place_search.hpp"

using namespace orca;
using namespace orca::nav;

namespace {

constexpr PoseSpread known_to(const Pose2& pose, double deviation, double turn) {
  return {pose, {deviation * deviation, 0, 0, 0, deviation * deviation, 0, 0, 0, turn * turn}};
}

/// A robot among walls that the map shows, whose wheels are right unless it slips.
struct Robot {
  explicit Robot(const test::Walls& drawn, Vec2 least, Vec2 most)
      : walls(drawn), map(std::make_shared<const KnownMap>(test::grid_of(drawn, least, most))) {}

  test::Walls walls;
  std::shared_ptr<const KnownMap> map;
  RandomStream random{3, "test", "scans"};
  MapLocalizer localizer{map, RandomStream(1, "test", "particles")};
  Pose2 X_MR{};
  Reckoned reckoned{};

  // @param slip  seen from the robot, by which the wheels turn but it does not move.
  void drive(const Pose2& step, const Pose2& slip = {}) {
    X_MR = X_MR * step;
    reckoned.X_OR = reckoned.X_OR * step * slip;
    reckoned.time += 0.5;
    localizer.move(reckoned);
    localizer.see(test::robot_scan(walls, X_MR, random));
  }
  [[nodiscard]] PoseSpread where() const { return *localizer.where(reckoned); }
};

}  // namespace

TEST_CASE("what is known of a pose that is one of two covers both", "[navigation]") {
  const PoseSpread near = known_to({1.0, 2.0, 3.1}, 0.1, 0.1);
  const PoseSpread far = known_to({1.4, 2.0, -3.1}, 0.2, 0.1);
  const PoseSpread either = mixed(near, far, 0.25);
  CHECK(either.mean == near.mean);
  CHECK(either.covariance[0] == Approx(0.75 * 0.01 + 0.25 * (0.04 + 0.16)));
  CHECK(either.covariance[4] == Approx(0.75 * 0.01 + 0.25 * 0.04));
  const double turn = wrapped(-6.2);
  CHECK(either.covariance[8] == Approx(0.01 + 0.25 * turn * turn));
  CHECK(either.covariance[2] == Approx(0.25 * 0.4 * turn));
  CHECK(either.covariance[2] == either.covariance[6]);
  CHECK(mixed(near, far, 0.0).covariance == near.covariance);
}

TEST_CASE(
    "a robot that a scan draws away from where its wheels have it may be at either, until walls refute one",
    "[navigation]") {
  Robot robot(test::two_rooms(), {-0.5, -0.5}, {10.5, 6.5});
  robot.X_MR = {2.0, 3.0, 0.0};
  robot.localizer.place(known_to(robot.X_MR, 0.01, 0.01), robot.reckoned);
  for (int i = 0; i < 20; ++i) robot.drive({0.02, 0.0, 0.0});
  CHECK(std::sqrt(robot.where().covariance[0]) < 0.03);
  robot.drive({0.0, 0.0, 0.0}, {-0.35, 0.0, 0.0});
  const PoseSpread drawn = robot.where();
  CHECK(test::apart(drawn.mean, robot.X_MR).way < 0.05);
  const Pose2 by_wheels{robot.X_MR.x - 0.35, robot.X_MR.y, robot.X_MR.yaw};
  CHECK(squared_distance(drawn, by_wheels) < 7.8);
  CHECK(robot.localizer.known(robot.reckoned) == Known::localized);
  // If it were nearer to the wall behind it, light would go through that wall.
  for (int i = 0; i < 40; ++i) robot.drive({0.0, 0.0, std::numbers::pi / 40.0});
  for (int i = 0; i < 10; ++i) robot.drive({});
  CHECK(std::sqrt(robot.where().covariance[0]) < 0.05);
  CHECK(test::apart(robot.where().mean, robot.X_MR).way < 0.05);
}

TEST_CASE("a robot in doubt between two places is at one again when it has come to other views",
          "[navigation]") {
  // Along a corridor nothing refutes a place.
  Robot robot({{{0.03, 0.02}, {80.03, 0.02}}, {{0.03, 2.02}, {80.03, 2.02}}}, {-0.5, -0.5}, {80.5, 2.5});
  Rivals rivals;
  rivals.contradict(known_to({40.0, 1.0, 0.0}, 0.02, 0.01));
  const PoseSpread believed = known_to({40.4, 1.0, 0.0}, 0.02, 0.01);
  CHECK(std::sqrt(rivals.with(believed).covariance[0]) == Approx(0.4 * std::sqrt(0.5)).epsilon(0.05));
  robot.X_MR = {40.4, 1.0, 0.0};
  const RobotScan scan = test::robot_scan(robot.walls, robot.X_MR, robot.random);
  const Explanation explained = robot.map->explain(scan.echoes, scan.from, robot.X_MR);
  const auto go_on = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      rivals.move({0.1, 0.0, 0.0}, {0.002, 0.002, 0.001});
      rivals.judge(scan, *robot.map, explained, {});
    }
  };
  go_on(40);
  CHECK_FALSE(rivals.empty());
  // Drawn again, it is in doubt again.
  rivals.contradict(believed);
  go_on(40);
  CHECK_FALSE(rivals.empty());
  go_on(15);
  CHECK(rivals.empty());
  CHECK(rivals.with(believed).covariance == believed.covariance);
}

TEST_CASE("a place that is said roughly is known no better than the places near it that show the same",
          "[navigation]") {
  // Columns along a corridor, all alike.
  test::Walls walls{{{0.03, 0.02}, {80.03, 0.02}}, {{0.03, 2.02}, {80.03, 2.02}}};
  const double apart = GENERATE(0.5, 0.6);
  for (double x = 0.4; x < 79.0; x += apart)
    for (const test::Wall& wall : test::box({x, 0.0}, {x + 0.2, 0.2})) walls.push_back(wall);
  Robot robot(walls, {-0.5, -0.5}, {80.5, 2.5});
  robot.X_MR = {40.0, 1.0, 0.0};
  robot.localizer.place(known_to({robot.X_MR.x + 0.55 * apart, 1.0, 0.0}, 0.3, 0.1), robot.reckoned);
  robot.drive({});
  CHECK(robot.localizer.known(robot.reckoned) == Known::localized);
  CHECK(squared_distance(robot.where(), robot.X_MR) < 7.8);
}
