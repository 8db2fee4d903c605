// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/navigator.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "orca/geometry/arc.hpp"

using namespace orca::nav;
using orca::Pose2;
using orca::TimePoint;
using orca::Vec2;

namespace {

constexpr Footprint kBase{0.254, 0.215, 0.333};
constexpr double kLap = 0.05;

struct Wall {
  Vec2 from;
  Vec2 to;
};

// Returns the way along a beam to the first wall; at most 5 m.
double range_of(const std::vector<Wall>& walls, Vec2 from, Vec2 axis) {
  double least = 5.0;
  for (const Wall& wall : walls) {
    const Vec2 along = wall.to - wall.from;
    const double turn = cross(axis, along);
    if (std::abs(turn) < 1e-12) continue;
    const double way = cross(wall.from - from, along) / turn;
    const double share = cross(wall.from - from, axis) / turn;
    if (way > 0.0 && share >= 0.0 && share <= 1.0) least = std::min(least, way);
  }
  return least;
}

std::vector<Beam> scan_of(const std::vector<Wall>& walls, const Pose2& pose) {
  std::vector<Beam> scan;
  for (int i = 0; i < 360; ++i) {
    const Vec2 axis = orca::direction(pose.yaw + i * std::numbers::pi / 180.0);
    const double range = range_of(walls, pose.position(), axis);
    scan.push_back({pose.position(), pose.position() + range * axis, range < 5.0});
  }
  return scan;
}

struct Drive {
  Pose2 end;
  double least_clearance = 1.0;
  int recoveries = 0;
  std::vector<Recovery> tried;  // what went on, in its order
};

const std::vector<Wall> kCell{{{-1.0, -1.0}, {1.0, -1.0}},
                              {{1.0, -1.0}, {1.0, 1.0}},
                              {{1.0, 1.0}, {-1.0, 1.0}},
                              {{-1.0, 1.0}, {-1.0, -1.0}}};

// Returns another navigator that knows what this one knows.
std::unique_ptr<Navigator> successor_of(Navigator& navigator) {
  auto next = std::make_unique<Navigator>(kBase, NavigatorRules{});
  next->state() = navigator.state();
  REQUIRE(next->unpack_map(navigator.map().packed()));
  return next;
}

// Drives a robot that obeys after one lap through a plane with walls.
// @param relieved_every  laps after which another navigator goes on; 0: never.
Drive drive_to(Vec2 goal, const std::vector<Wall>& walls, double seconds, int relieved_every = 0,
               const NavigatorRules& rules = {}) {
  auto owned = std::make_unique<Navigator>(kBase, rules);
  int laps = 0;
  std::optional<Recovery> last;
  Drive drive;
  orca::Twist2 twist;
  for (double time = 0.0; time < seconds && norm(drive.end.position() - goal) > 0.2; time += kLap) {
    if (relieved_every > 0 && ++laps % relieved_every == 0) owned = successor_of(*owned);
    Navigator& navigator = *owned;
    const std::vector<Beam> scan = scan_of(walls, drive.end);
    navigator.hear(scan, drive.end);
    const Steer steer = navigator.steer({TimePoint{orca::from_seconds(time)}, drive.end, twist}, {goal});
    drive.end = along_arc(drive.end, twist * kLap);
    twist = {steer.speed, 0.0, steer.turn_rate};
    for (const Beam& beam : scan)
      if (beam.echo)
        drive.least_clearance =
            std::min(drive.least_clearance, clearance(kBase, seen_from(drive.end, beam.to)));
    drive.recoveries = std::max(drive.recoveries, navigator.recoveries());
    const auto recovery = navigator.recovery();
    if (recovery && recovery != last) drive.tried.push_back(*recovery);
    last = recovery;
  }
  return drive;
}

}  // namespace

TEST_CASE("the navigator gets out of a U that it can only see from within", "[navigation]") {
  const std::vector<Wall> u{
      {{1.5, -1.0}, {1.5, 1.0}}, {{-0.5, 1.0}, {1.5, 1.0}}, {{-0.5, -1.0}, {1.5, -1.0}}};
  const Drive drive = drive_to({4.0, 0.0}, u, 60.0);
  CHECK(norm(drive.end.position() - Vec2{4.0, 0.0}) < 0.21);
  CHECK(drive.least_clearance > 0.0);
}

TEST_CASE("the navigator drives through a door that is 10 cm wider than the robot, from aside",
          "[navigation]") {
  const double half = kBase.half_width + 0.05;
  const std::vector<Wall> door{{{2.0, half}, {2.0, 9.0}}, {{2.0, -half}, {2.0, -9.0}}};
  const Drive drive = drive_to({4.0, 1.5}, door, 60.0);
  CHECK(norm(drive.end.position() - Vec2{4.0, 1.5}) < 0.21);
  CHECK(drive.least_clearance > 0.0);
}

TEST_CASE("shut in, the navigator tries to recover and touches nothing", "[navigation]") {
  const Drive drive = drive_to({4.0, 0.0}, kCell, 30.0);
  CHECK(std::abs(drive.end.x) < 1.0);
  CHECK(std::abs(drive.end.y) < 1.0);
  CHECK(drive.recoveries > 0);
  CHECK(drive.least_clearance > 0.0);
}

TEST_CASE("shut in, the navigator tries its recoveries in turn, but for a turn that finds no room",
          "[navigation]") {
  const Drive drive = drive_to({4.0, 0.0}, kCell, 90.0);
  REQUIRE(drive.tried.size() > kUsualRecoveries.size());
  const auto usual = [](std::size_t turn) { return kUsualRecoveries[turn % kUsualRecoveries.size()]; };
  std::size_t turn = 0;
  std::size_t turns_on_the_spot = 0;
  for (const Recovery tried : drive.tried) {
    if (usual(turn) == Recovery::look_around && tried != Recovery::look_around) ++turn;
    CHECK(tried == usual(turn++));
    turns_on_the_spot += tried == Recovery::look_around ? 1 : 0;
  }
  CHECK(turns_on_the_spot > 0);
}

TEST_CASE("a navigator without recoveries stands where nothing leads on", "[navigation]") {
  NavigatorRules rules;
  rules.recoveries.clear();
  const Drive drive = drive_to({4.0, 0.0}, kCell, 30.0, 0, rules);
  CHECK(drive.recoveries == 0);
  CHECK(drive.tried.empty());
  CHECK(drive.least_clearance > 0.0);
}

TEST_CASE("a recovery that can do nothing gives way to the next at once", "[navigation]") {
  // It cannot turn round between two walls, and has driven over nothing behind it.
  const std::vector<Wall> slot{{{-0.35, 0.26}, {0.4, 0.26}},
                               {{-0.35, -0.26}, {0.4, -0.26}},
                               {{0.3, -0.26}, {0.3, 0.26}},
                               {{-0.3, -0.26}, {-0.3, 0.26}}};
  NavigatorRules rules;
  rules.recoveries = {Recovery::look_around, Recovery::back_off, Recovery::wait};
  const Drive drive = drive_to({4.0, 0.0}, slot, 20.0, 0, rules);
  REQUIRE_FALSE(drive.tried.empty());
  for (const Recovery recovery : drive.tried) CHECK(recovery == Recovery::wait);
}

TEST_CASE("a navigator gets past what has gone where no echo says that it has", "[navigation]") {
  const std::vector<Wall> gap{{{1.5, 0.4}, {1.5, 3.0}},
                              {{1.5, -0.4}, {1.5, -3.0}},
                              {{-1.0, 3.0}, {1.5, 3.0}},
                              {{-1.0, -3.0}, {1.5, -3.0}},
                              {{-1.0, -3.0}, {-1.0, 3.0}}};
  std::vector<Wall> blocked = gap;
  blocked.push_back({{1.5, -0.4}, {1.5, 0.4}});
  for (const bool recovers : {false, true}) {
    NavigatorRules rules;
    if (!recovers) rules.recoveries.clear();
    Navigator navigator(kBase, rules);
    Pose2 pose;
    orca::Twist2 twist;
    for (double time = 0.0; time < 30.0 && pose.x < 2.5; time += kLap) {
      navigator.hear(scan_of(time < 3.0 ? blocked : gap, pose), pose);
      const Steer steer = navigator.steer({TimePoint{orca::from_seconds(time)}, pose, twist}, {{3.0, 0.0}});
      pose = along_arc(pose, twist * kLap);
      twist = {steer.speed, 0.0, steer.turn_rate};
    }
    CAPTURE(recovers);
    CHECK((pose.x >= 2.5) == recovers);
  }
}

TEST_CASE("recoveries have names", "[navigation]") {
  for (const Recovery recovery : kUsualRecoveries) CHECK(recovery_of(name_of(recovery)) == recovery);
  CHECK_FALSE(recovery_of("spin"));
}

TEST_CASE("a navigator that goes on with what another one knows drives the same, also while it recovers",
          "[navigation]") {
  const std::vector<Wall> u{
      {{1.5, -1.0}, {1.5, 1.0}}, {{-0.5, 1.0}, {1.5, 1.0}}, {{-0.5, -1.0}, {1.5, -1.0}}};
  for (const auto& walls : {u, kCell}) {
    const Drive alone = drive_to({4.0, 0.0}, walls, 30.0);
    const Drive relieved = drive_to({4.0, 0.0}, walls, 30.0, 7);
    CHECK(relieved.end == alone.end);
    CHECK(relieved.recoveries == alone.recoveries);
  }
}

TEST_CASE("a map of another size is not taken over", "[navigation]") {
  NavigatorRules small;
  small.extent = 8.0;
  Navigator navigator(kBase, small);
  navigator.hear(scan_of({{{-1.0, 2.0}, {6.0, 2.0}}}, {}), {});
  CHECK_FALSE(navigator.unpack_map(Navigator(kBase, {}).map().packed()));
  CHECK_FALSE(navigator.unpack_map("rubbish"));
  CHECK(navigator.map().occupied(navigator.map().lattice().cell_at({0.0, 2.0})));
}

TEST_CASE("the navigator names the place ahead on its path, and none while it knows no way", "[navigation]") {
  Navigator navigator(kBase, {});
  const Moment moment{TimePoint{}, {}, {0.5, 0.0, 0.0}};
  CHECK_FALSE(navigator.ahead(moment));

  navigator.hear(scan_of({{{-1.0, 2.0}, {6.0, 2.0}}}, {}), {});
  (void)navigator.steer(moment, {{4.0, 0.0}});
  const auto ahead = navigator.ahead(moment);
  REQUIRE(ahead);
  CHECK(ahead->x == Approx(0.45).margin(0.05));  // 0.9 s at 0.5 m/s
  CHECK(std::abs(ahead->y) < 0.1);

  navigator.drop_path();
  CHECK_FALSE(navigator.ahead(moment));
}

TEST_CASE("a robot whose pose jumps out of the map stands until a scan is heard there", "[navigation]") {
  Navigator navigator(kBase, {});
  const std::vector<Wall> wall{{{-1.0, 2.0}, {6.0, 2.0}}};
  const auto speed_at = [&](Vec2 place) {
    const Moment moment{TimePoint{}, {place.x, place.y, 0.0}, {0.5, 0.0, 0.0}};
    return navigator.steer(moment, {place + Vec2{4.0, 0.0}}).speed;
  };
  navigator.hear(scan_of(wall, {}), {});
  REQUIRE(speed_at({}) > 0.1);
  for (const Vec2 place : {Vec2{30.0, 0.0}, Vec2{-3000.0, 6000.0}, Vec2{1e7, 1e7}}) {
    CHECK(speed_at(place) == 0.0);
    const Pose2 there{place.x, place.y, 0.0};
    navigator.hear(scan_of(wall, there), there);
    CHECK(speed_at(place) > 0.1);
  }
}
