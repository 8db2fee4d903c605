// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/map_localizer.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "grids.hpp"

using namespace orca;
using namespace orca::nav;
using test::apart;

namespace {

constexpr PoseSpread around(const Pose2& pose) { return {pose, {0.04, 0, 0, 0, 0.04, 0, 0, 0, 0.02}}; }

/// A robot that drives in circles through the door of two rooms, with odometry that is 3 % too long and drifts to one side.
struct Drive {
  test::Walls walls = test::two_rooms();
  std::shared_ptr<const KnownMap> map = std::make_shared<const KnownMap>(test::two_rooms_grid());
  RandomStream random{3, "test", "drive"};
  MapLocalizer localizer{map, RandomStream(1, "test", "particles")};
  Pose2 X_MR{3.0, 3.0, 0.0};
  Reckoned reckoned{};
  bool sees = true;

  // Puts the robot among other walls, all of which its map shows.
  void build(const std::vector<test::Walls>& parts, Vec2 least, Vec2 most) {
    walls.clear();
    for (const test::Walls& part : parts) walls.insert(walls.end(), part.begin(), part.end());
    draw(walls, least, most);
  }
  void draw(const test::Walls& drawn, Vec2 least, Vec2 most) {
    map = std::make_shared<const KnownMap>(test::grid_of(drawn, least, most));
    localizer.change_map(map);
  }

  void drive(const Pose2& step) {
    X_MR = X_MR * step;
    reckoned.X_OR = reckoned.X_OR * Pose2{1.03 * step.x, 0.0, step.yaw + 0.01 * step.x};
    reckoned.time += 0.1;
    localizer.move(reckoned);
    if (sees) localizer.see(test::robot_scan(walls, X_MR, random));
  }
  void go_on(int steps, const Pose2& step = {0.05, 0.0, 0.0}) {
    for (int i = 0; i < steps; ++i) drive(step);
  }
  void stand(int steps) { go_on(steps, {}); }
  // Two metres to and fro through the door, with turns at the ends.
  void wander() {
    for (int i = 0; i < 2; ++i) {
      go_on(60);
      go_on(30, {0.0, 0.0, std::numbers::pi / 30.0});
    }
  }
  [[nodiscard]] Known known() const { return localizer.known(reckoned); }
  [[nodiscard]] double off() const {
    const auto where = localizer.where(reckoned);
    return where ? apart(where->mean, X_MR).way : 1e9;
  }
};

}  // namespace

TEST_CASE("a robot whose place is said is followed, whatever its wheels do", "[navigation]") {
  Drive drive;
  drive.localizer.place(around({3.2, 2.9, 0.1}), drive.reckoned);
  drive.stand(1);
  double worst = 0.0;
  for (int round = 0; round < 3; ++round)
    for (int i = 0; i < 2; ++i) {
      drive.go_on(60);
      worst = std::max(worst, drive.off());
      drive.go_on(30, {0.0, 0.0, std::numbers::pi / 30.0});
      worst = std::max(worst, drive.off());
    }
  CHECK(drive.known() == Known::localized);
  CHECK(worst < 0.06);
  const auto where = drive.localizer.where(drive.reckoned);
  REQUIRE(where);
  CHECK(where->covariance[0] < 0.05 * 0.05);
}

TEST_CASE("a robot whose place nobody has said is found, at once or by what it sees on its way",
          "[navigation]") {
  for (const Pose2& start : {Pose2{3.0, 3.0, 0.0}, {8.0, 2.5, 2.0}, {1.0, 1.0, 0.8}}) {
    Drive drive;
    drive.X_MR = start;
    CHECK(drive.known() == Known::unknown);
    drive.stand(10);
    const bool at_once = drive.known() == Known::localized;
    CHECK((at_once ? drive.off() < 0.05 : drive.known() == Known::ambiguous));
    drive.go_on(20);
    drive.go_on(40, {0.0, 0.0, std::numbers::pi / 20.0});
    CHECK(drive.known() == Known::localized);
    CHECK(drive.off() < 0.05);
  }
}

TEST_CASE("a robot in one of two rooms alike is at either, until it sees more", "[navigation]") {
  Drive drive;
  // Two equal rooms that are 4 m by 3 m, so each is alike to itself when it is turned by half a circle. A box at the wall of one shows in no other.
  drive.build({test::box({0.03, 0.02}, {4.03, 3.02}), test::box({6.03, 0.02}, {10.03, 3.02}),
               test::box({0.5, 2.3}, {1.2, 3.0})},
              {-0.5, -0.5}, {10.5, 3.5});
  // The box is behind it.
  drive.X_MR = {2.2, 1.3, -0.5};
  drive.stand(40);
  CHECK(drive.known() == Known::ambiguous);
  CHECK(drive.localizer.places(drive.reckoned).size() >= 3);
  drive.go_on(30, {0.0, 0.0, 0.1});
  drive.go_on(20);
  CHECK(drive.known() == Known::localized);
  CHECK(drive.off() < 0.05);
}

TEST_CASE("a robot in one of two rooms that are alike all around stays at either", "[navigation]") {
  Drive drive;
  drive.build({test::box({0.03, 0.02}, {4.03, 4.02}), test::box({6.03, 0.02}, {10.03, 4.02})}, {-0.5, -0.5},
              {10.5, 4.5});
  drive.X_MR = {1.3, 1.7, 0.3};
  drive.stand(40);
  CHECK(drive.known() == Known::ambiguous);
  CHECK(drive.localizer.places(drive.reckoned).size() >= 2);
  drive.go_on(20);
  drive.go_on(60, {0.0, 0.0, 0.1});
  CHECK(drive.known() == Known::ambiguous);
}

TEST_CASE("a search leaves a place the evidence against it that other scans gave", "[navigation]") {
  Drive drive;
  drive.build({test::box({0.03, 0.02}, {4.03, 4.02}), test::box({6.03, 0.02}, {10.03, 4.02})}, {-0.5, -0.5},
              {10.5, 4.5});
  drive.X_MR = {1.3, 1.7, 0.3};
  // The best place is doubted, so the next scan begins a search, in which both rooms look alike.
  const PlaceBelief here{.where = around(drive.X_MR), .quick = 0.3, .slow = 0.8};
  const Pose2 elsewhere{7.3, 1.7, 0.3};
  const PlaceBelief there{.where = around(elsewhere), .odds = -5.0, .quick = 0.3, .slow = 0.8};
  drive.localizer.resume(std::array{here, there}, true, drive.reckoned);
  drive.localizer.see(test::robot_scan(drive.walls, drive.X_MR, drive.random));
  while (drive.localizer.searches()) drive.stand(1);
  for (const PlaceBelief& place : drive.localizer.places(drive.reckoned)) {
    const auto off = apart(place.where.mean, elsewhere);
    if (off.way < 0.3 && off.turn < 0.2) CHECK(place.odds < -2.0);
  }
  CHECK(drive.off() < 0.1);
}

TEST_CASE("a search that began in doubt moves no robot whose place fits again when it ends", "[navigation]") {
  const test::Walls crate = test::box({7.0, 2.8}, {7.6, 3.6});
  const test::Walls walls = test::box({0.03, 0.02}, {4.03, 4.02});
  test::Walls drawn = walls;
  for (const test::Walls& more : {test::box({6.03, 0.02}, {10.03, 4.02}), crate})
    drawn.insert(drawn.end(), more.begin(), more.end());
  const auto map = std::make_shared<const KnownMap>(test::grid_of(drawn, {-0.5, -0.5}, {10.5, 4.5}));
  LocalizerOptions options;
  options.looks = 20'000;
  MapLocalizer localizer(map, RandomStream(1, "test", "particles"), options);
  RandomStream random(3, "test", "scans");
  Reckoned now;
  const Pose2 X_MR{1.3, 1.7, 0.3};
  const PlaceBelief here{.where = around(X_MR), .quick = 0.3, .slow = 0.8};
  localizer.resume(std::array{here}, true, now);
  // For one scan a crate stands where one is drawn in the other room.
  test::Walls for_one_scan = walls;
  for (const test::Wall& wall : crate)
    for_one_scan.push_back({wall.from - Vec2{6.0, 0.0}, wall.to - Vec2{6.0, 0.0}});
  localizer.see(test::robot_scan(for_one_scan, X_MR, random));
  int scans = 0;
  for (; localizer.searches() && scans < 200; ++scans) {
    now.time += 0.5;
    localizer.move(now);
    localizer.see(test::robot_scan(walls, X_MR, random));
  }
  CHECK(scans >= 10);
  CHECK(localizer.known(now) == Known::localized);
  CHECK(apart(localizer.where(now)->mean, X_MR).way < 0.1);
}

TEST_CASE("a robot that was carried off notices, and is found again", "[navigation]") {
  Drive drive;
  drive.localizer.place(around(drive.X_MR), drive.reckoned);
  drive.wander();
  REQUIRE(drive.known() == Known::localized);
  drive.X_MR = {8.2, 2.2, 2.5};
  int steps = 0;
  while (drive.known() == Known::localized && drive.off() > 0.1 && steps < 100) drive.stand(1), ++steps;
  CHECK(steps <= 30);  // 3 s
  drive.go_on(20);
  CHECK(drive.known() == Known::localized);
  CHECK(drive.off() < 0.05);
}

TEST_CASE("people around a robot do not make it lost", "[navigation]") {
  Drive drive;
  drive.localizer.place(around(drive.X_MR), drive.reckoned);
  drive.stand(2);
  double worst = 0.0;
  for (int i = 0; i < 60; ++i) {
    drive.sees = false;
    drive.go_on(1);
    RobotScan scan = test::robot_scan(drive.walls, drive.X_MR, drive.random);
    // Three people, each of whom hides a tenth of the beams.
    for (std::size_t beam = 0; beam < scan.echoes.size(); ++beam) {
      Vec2& at = scan.echoes[beam].at;
      if (beam % 60 < 18 && norm(at) > 0.8) at = 0.7 / norm(at) * at;
    }
    drive.localizer.see(scan);
    worst = std::max(worst, drive.off());
    CHECK(drive.known() == Known::localized);
  }
  CHECK(worst < 0.06);
}

TEST_CASE("a robot that loses its place among people is found in its own room, not in one alike",
          "[navigation]") {
  Drive drive;
  drive.build({test::box({0.03, 0.02}, {4.03, 3.02}), test::box({6.03, 0.02}, {10.03, 3.02}),
               test::box({0.5, 2.3}, {1.2, 3.0}), test::box({6.5, 2.3}, {7.2, 3.0})},
              {-0.5, -0.5}, {10.5, 3.5});
  drive.X_MR = {GENERATE(2.2, 8.2), 1.3, 0.5};
  drive.localizer.place(around(drive.X_MR), drive.reckoned);
  drive.stand(20);
  REQUIRE(drive.known() == Known::localized);
  drive.sees = false;
  for (int i = 0; i < 60; ++i) {
    drive.stand(1);
    RobotScan scan = test::robot_scan(drive.walls, drive.X_MR, drive.random);
    for (SurfacePoint& echo : scan.echoes) echo.at = 0.4 / norm(echo.at) * echo.at;
    drive.localizer.see(scan);
  }
  CHECK(drive.known() != Known::localized);
  drive.sees = true;
  drive.go_on(60, {0.0, 0.0, 0.05});
  CHECK(drive.known() == Known::localized);
  CHECK(drive.off() < 0.05);
}

TEST_CASE("a crate before a robot that hides half of what it sees does not make it lost", "[navigation]") {
  Drive drive;
  drive.localizer.place(around(drive.X_MR), drive.reckoned);
  drive.wander();
  REQUIRE(drive.known() == Known::localized);
  drive.sees = false;
  for (int i = 0; i < 60; ++i) {
    drive.stand(1);
    RobotScan scan = test::robot_scan(drive.walls, drive.X_MR, drive.random);
    for (SurfacePoint& echo : scan.echoes)
      if (echo.at.x > 0.4 && std::fabs(echo.at.y) < echo.at.x) echo.at = 0.4 / echo.at.x * echo.at;
    drive.localizer.see(scan);
    CHECK(drive.known() == Known::localized);
  }
  CHECK(drive.off() < 0.05);
}

TEST_CASE("a crate that was moved along a corridor does not draw a robot with it", "[navigation]") {
  Drive drive;
  const test::Walls corridor{{{0.03, 0.02}, {30.03, 0.02}}, {{0.03, 2.02}, {30.03, 2.02}}};
  const auto with_crate_at = [&](double x) {
    test::Walls walls = corridor;
    const test::Walls crate = test::box({x, 0.3}, {x + 0.8, 1.4});
    walls.insert(walls.end(), crate.begin(), crate.end());
    return walls;
  };
  drive.draw(with_crate_at(12.0), {-0.5, -0.5}, {30.5, 2.5});
  drive.walls = with_crate_at(12.0 + GENERATE(0.1, 0.15, 0.2, 0.25));
  drive.X_MR = {8.0, 1.0, 0.0};
  drive.localizer.place({drive.X_MR, {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4}}, drive.reckoned);
  drive.stand(30);
  CHECK(drive.off() < 0.05);
}

TEST_CASE("a robot in another building is not found", "[navigation]") {
  Drive drive;
  drive.walls = test::box({0.0, 0.0}, {3.1, 14.0});
  for (const test::Walls& more : {test::box({0.0, 2.0}, {1.2, 3.3}), test::box({2.2, 5.0}, {3.1, 9.0})})
    drive.walls.insert(drive.walls.end(), more.begin(), more.end());
  drive.X_MR = {1.6, 4.0, 1.5};
  drive.stand(30);
  drive.go_on(60);
  CHECK(drive.known() != Known::localized);
}

TEST_CASE("a place where light goes through a wall of the map is not believed before views that fit",
          "[navigation]") {
  Drive drive;
  drive.walls = {{{0.03, 0.02}, {0.03, 5.02}}, {{0.03, 0.02}, {6.03, 0.02}}, {{0.03, 5.02}, {6.03, 5.02}}};
  for (const test::Walls& more : {test::box({4.6, 0.0}, {5.1, 0.6}), test::box({4.2, 4.0}, {5.0, 5.0}),
                                  test::box({1.0, 0.0}, {2.0, 0.7})})
    drive.walls.insert(drive.walls.end(), more.begin(), more.end());
  // On its fourth side the room has an opening, which the map does not show.
  test::Walls drawn = drive.walls;
  drawn.push_back({{6.03, 0.02}, {6.03, 5.02}});
  for (const test::Wall& wall :
       test::Walls{{{6.03, 0.02}, {6.03, 1.5}}, {{6.03, 2.7}, {6.03, 5.02}}, {{9.03, 0.0}, {9.03, 5.0}}})
    drive.walls.push_back(wall);
  drive.draw(drawn, {-0.5, -0.5}, {6.5, 5.5});
  drive.X_MR = {4.0, 2.2, 0.0};
  drive.stand(40);
  const auto places = drive.localizer.places(drive.reckoned);
  REQUIRE(places.size() == 1);
  CHECK(places.front().quick > LocalizerOptions{}.believed_from);
  CHECK(drive.off() < 0.1);
  CHECK(drive.known() == Known::unknown);
  // The opening is behind the robot.
  drive.go_on(40, {0.0, 0.0, std::numbers::pi / 40.0});
  drive.stand(150);
  CHECK(drive.known() == Known::localized);
  CHECK(drive.off() < 0.1);
  // A place that somebody says is believed all the same.
  drive.X_MR = {4.0, 2.2, 0.0};
  drive.localizer.place(around(drive.X_MR), drive.reckoned);
  drive.stand(40);
  CHECK(drive.known() == Known::localized);
}

TEST_CASE("a robot that senses nothing is lost after a while, and goes on when it does again",
          "[navigation]") {
  Drive drive;
  drive.localizer.place(around(drive.X_MR), drive.reckoned);
  drive.wander();
  drive.sees = false;
  drive.stand(20);
  CHECK(drive.known() == Known::localized);
  drive.stand(20);
  CHECK(drive.known() == Known::lost);
  drive.sees = true;
  drive.stand(1);
  CHECK(drive.known() == Known::localized);
}

TEST_CASE("a laser that sees only its largest range says nothing", "[navigation]") {
  Drive drive;
  drive.localizer.place(around(drive.X_MR), drive.reckoned);
  drive.wander();
  drive.sees = false;
  for (int i = 0; i < 50; ++i) {
    drive.go_on(1);
    drive.localizer.see({1, {}, {}, 181});
  }
  CHECK(drive.known() == Known::lost);
}

TEST_CASE("a place from before is checked before it is believed", "[navigation]") {
  Drive drive;
  drive.localizer.suggest(around({3.1, 2.9, 0.05}), drive.reckoned);
  CHECK(drive.known() == Known::unknown);
  drive.stand(1);
  CHECK(drive.known() == Known::localized);
  Drive carried;
  carried.X_MR = {8.2, 2.2, 2.5};
  carried.localizer.suggest(around({3.1, 2.9, 0.05}), carried.reckoned);
  carried.stand(1);
  CHECK(carried.known() != Known::localized);
  carried.stand(60);
  carried.go_on(20);
  CHECK(carried.known() == Known::localized);
  CHECK(carried.off() < 0.05);
}

TEST_CASE("a place from before gives way to one along the same corridor that fits better", "[navigation]") {
  Drive drive;
  drive.build({test::box({0.03, 0.02}, {24.03, 2.02}), test::box({5.0, 0.0}, {5.5, 0.4}),
               test::box({9.0, 1.5}, {9.3, 2.0}), test::box({16.0, 0.0}, {16.8, 0.3})},
              {-0.5, -0.5}, {24.5, 2.5});
  drive.X_MR = {3.0, 1.0, 0.0};
  drive.localizer.suggest(around({11.0, 1.0, 0.0}), drive.reckoned);
  drive.stand(20);
  CHECK((drive.known() != Known::localized || drive.off() < 0.1));
  drive.go_on(80);
  CHECK(drive.known() == Known::localized);
  CHECK(drive.off() < 0.1);
}

TEST_CASE("a place from before is believed although others fit as well", "[navigation]") {
  Drive drive;
  drive.build({test::box({0.03, 0.02}, {4.03, 3.02}), test::box({6.03, 0.02}, {10.03, 3.02})}, {-0.5, -0.5},
              {10.5, 3.5});
  drive.X_MR = {8.2, 1.3, -0.5};
  drive.localizer.suggest(around({8.1, 1.4, -0.45}), drive.reckoned);
  drive.stand(40);
  CHECK(drive.known() == Known::localized);
  CHECK(drive.off() < 0.05);
}

TEST_CASE("a localizer that takes another's place goes on with what that believed", "[navigation]") {
  Drive drive;
  drive.localizer.place(around(drive.X_MR), drive.reckoned);
  drive.wander();
  const auto places = drive.localizer.places(drive.reckoned);
  const auto before = drive.localizer.where(drive.reckoned);
  REQUIRE(places.size() == 1);
  MapLocalizer next(drive.map, RandomStream(7, "test", "particles"));
  next.resume(places, true, drive.reckoned);
  CHECK(next.known(drive.reckoned) == Known::localized);
  const auto after = next.where(drive.reckoned);
  CHECK(apart(after->mean, before->mean).way < 1e-6);
  CHECK(after->covariance[0] == Approx(before->covariance[0]).epsilon(0.5));
}

TEST_CASE("odometry that begins anew is no way of the robot", "[navigation]") {
  Drive drive;
  drive.localizer.place(around(drive.X_MR), drive.reckoned);
  drive.wander();
  drive.reckoned.X_OR = {};
  drive.localizer.reckon_anew(drive.reckoned);
  CHECK(drive.known() != Known::localized);
  CHECK(drive.off() < 0.05);
  drive.stand(10);
  CHECK(drive.known() == Known::localized);
}

TEST_CASE("a clock that is set back or on loses no place", "[navigation]") {
  Drive drive;
  drive.localizer.place(around(drive.X_MR), drive.reckoned);
  drive.wander();
  for (const double jump : {-3600.0, 7200.0}) {
    drive.reckoned.time += jump;
    drive.stand(2);
    CHECK(drive.known() == Known::localized);
    drive.wander();
    CHECK(drive.known() == Known::localized);
    CHECK(drive.off() < 0.06);
  }
}

TEST_CASE("the same scans and seed give the same place", "[navigation]") {
  const auto end = [] {
    Drive drive;
    drive.stand(30);
    drive.wander();
    return drive.localizer.where(drive.reckoned)->mean;
  };
  CHECK(end() == end());
}
