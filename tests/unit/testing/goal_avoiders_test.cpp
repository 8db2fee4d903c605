// SPDX-License-Identifier: GPL-3.0-or-later
// What Dwa, NdPlus and PotentialField say on scans that the test makes up.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/testing/component_trial.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;

namespace {

constexpr double kBeam = std::numbers::pi / 180;
constexpr double kUnseen = 8.0;  // [m]

using RangeAt = std::function<double(double angle)>;

const RangeAt kOpenFloor = [](double) { return kUnseen; };

// A wall across the way ahead, that wide to either side [m].
RangeAt wall_ahead(double distance, double half_width) {
  return [=](double angle) {
    const bool hit = std::abs(angle) < 89 * kBeam && std::abs(distance * std::tan(angle)) <= half_width;
    return hit ? distance / std::cos(angle) : kUnseen;
  };
}

struct Base final : Partner {
  using Partner::Partner;
  PushServer<idl::LaserRangeReadings> laser{*this, "laser"};
  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushServer<idl::GoalPoint> goal{*this, "goal"};
  PushProxy<idl::MotionCommand> motion{*this, "motion"};

  void scan(const RangeAt& range_at) {
    auto readings = laser.loan();
    readings->min_range(0.02);
    readings->max_range(kUnseen);
    readings->angle_start(-180 * kBeam);
    readings->angle_increment(kBeam);
    for (int i = 0; i < 360; ++i) readings->ranges().push_back(range_at((i - 180) * kBeam));
    readings->stamp(to_time_value(now()));
    laser.push(std::move(readings));
  }

  void drive_to(double x, double y) {
    auto place = goal.loan();
    place->coordinate().point().x(x);
    place->coordinate().point().y(y);
    place->reach_radius().distance(0.2);
    goal.push(std::move(place));
  }

  ObjectPtr<idl::MotionCommand> at_origin(double speed) {
    auto here = odometry.loan();
    here->translational_velocity(speed);
    here->stamp(to_time_value(now()));
    odometry.push(std::move(here));
    return motion.get_update_wait();
  }
};

struct Case {
  RangeAt seen = kOpenFloor;
  double goal_x = 5.0;
  double goal_y = 0.0;
  bool has_goal = true;
  double speed = 0.0;
};

ObjectPtr<idl::MotionCommand> said_by(const char* type, const Case& given) {
  ObjectPtr<idl::MotionCommand> said;
  try_component<Base>({.type = type}, [&](Base& test) {
    test.scan(given.seen);
    if (given.has_goal) test.drive_to(given.goal_x, given.goal_y);
    said = test.at_origin(given.speed);
  });
  return said;
}

}  // namespace

TEST_CASE(
    "with a goal Dwa and NdPlus drive alone: a turn rate and a speed with full weight, on open floor too",
    "[testing][dwa][nd]") {
  const char* const type = GENERATE("orca.Dwa", "orca.NdPlus");
  const auto ahead = said_by(type, {});
  CHECK(ahead->kind() == idl::MotionKind::NORMAL);
  CHECK(ahead->steering() == idl::BY_TURN_RATE);
  CHECK(ahead->turn_rate() == 0.0);
  CHECK(ahead->speed() > 0.1);
  CHECK(ahead->weight() == Approx(2000.0));
  CHECK(said_by(type, {.goal_x = 3.0, .goal_y = 3.0})->turn_rate() > 0.1);
  CHECK(said_by(type, {.goal_x = 3.0, .goal_y = -3.0})->turn_rate() < -0.1);
}

TEST_CASE("without a goal Dwa and NdPlus have no opinion while the way ahead is free", "[testing][dwa][nd]") {
  const char* const type = GENERATE("orca.Dwa", "orca.NdPlus");
  CHECK(said_by(type, {.has_goal = false})->kind() == idl::MotionKind::DONTCARE);
  CHECK(said_by(type, {.seen = wall_ahead(0.6, 0.5), .has_goal = false, .speed = 0.3})->kind() ==
        idl::MotionKind::NORMAL);
}

TEST_CASE("within reach of the goal Dwa and NdPlus leave coming to rest to others, if the robot can stop",
          "[testing][dwa][nd]") {
  const char* const type = GENERATE("orca.Dwa", "orca.NdPlus");
  const Case arriving{.goal_x = 0.1, .speed = 0.3};
  CHECK(said_by(type, arriving)->kind() == idl::MotionKind::DONTCARE);
  Case before_a_wall = arriving;
  before_a_wall.seen = wall_ahead(0.33, 0.5);
  CHECK(said_by(type, before_a_wall)->kind() == idl::MotionKind::NORMAL);
  CHECK(said_by(type, before_a_wall)->speed() < 0.5 * arriving.speed);
}

TEST_CASE("before a wall Dwa turns without driving on", "[testing][dwa]") {
  const auto said = said_by("orca.Dwa", {.seen = wall_ahead(0.27, 0.6)});
  CHECK(said->speed() == 0.0);
  CHECK(std::abs(said->turn_rate()) > 0.1);
}

TEST_CASE("NdPlus drives slower where something is near on both sides of its way", "[testing][nd]") {
  const RangeAt corridor = [](double angle) {
    return std::min(kUnseen, 0.35 / std::max(1e-9, std::abs(std::sin(angle))));
  };
  const auto free = said_by("orca.NdPlus", {});
  const auto between = said_by("orca.NdPlus", {.seen = corridor});
  CHECK(free->speed() == Approx(0.4));
  CHECK(between->speed() < 0.3);
  CHECK(between->speed() > 0.05);
  CHECK(between->turn_rate() == Approx(0.0).margin(0.05));
}

TEST_CASE("NdPlus leads past the edge of a wall that is nearest to the goal", "[testing][nd]") {
  const auto left = said_by("orca.NdPlus", {.seen = wall_ahead(1.0, 0.5), .goal_y = 1.0});
  const auto right = said_by("orca.NdPlus", {.seen = wall_ahead(1.0, 0.5), .goal_y = -1.0});
  CHECK(left->turn_rate() > 0.3);
  CHECK(right->turn_rate() == Approx(-left->turn_rate()).margin(0.1));
}

TEST_CASE("in a closed room NdPlus turns on the spot, to the side of the goal", "[testing][nd]") {
  const RangeAt closed = [](double) { return 0.8; };
  for (const double side : {1.0, -1.0}) {
    const auto said = said_by("orca.NdPlus", {.seen = closed, .goal_y = side});
    CHECK(said->speed() == 0.0);
    CHECK(said->turn_rate() * side > 0.1);
  }
}

TEST_CASE("PotentialField turns towards the goal with full weight", "[testing][field]") {
  const auto said = said_by("orca.PotentialField", {.goal_x = 3.0, .goal_y = 3.0});
  CHECK(said->steering() == idl::BY_TURN_RATE);
  CHECK(said->turn_rate() == Approx(std::numbers::pi / 4));
  CHECK(said->weight() == Approx(2000.0));
}

TEST_CASE(
    "PotentialField drives slower towards a wall, and not at all where it repels more than the goal attracts",
    "[testing][field]") {
  const auto free = said_by("orca.PotentialField", {});
  const auto before = said_by("orca.PotentialField", {.seen = wall_ahead(0.7, 0.5)});
  const auto at = said_by("orca.PotentialField", {.seen = wall_ahead(0.3, 0.5)});
  CHECK(free->speed() == Approx(0.4));
  CHECK(before->speed() < free->speed());
  CHECK(before->speed() > 0.0);
  CHECK(at->speed() == 0.0);
}

TEST_CASE("without a goal PotentialField speaks only where something repels the robot", "[testing][field]") {
  CHECK(said_by("orca.PotentialField", {.has_goal = false})->kind() == idl::MotionKind::DONTCARE);
  CHECK(said_by("orca.PotentialField", {.seen = wall_ahead(0.5, 0.5), .has_goal = false})->kind() ==
        idl::MotionKind::NORMAL);
}
