// SPDX-License-Identifier: GPL-3.0-or-later
// What Dwa, NdPlus and PotentialField say on scans that the test makes up.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "seeing_partner.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;

namespace {

struct Case {
  Shape seen = kNothing;
  double goal_x = 5.0;
  double goal_y = 0.0;
  bool has_goal = true;
  double speed = 0.0;
};

ObjectPtr<idl::MotionCommand> said_by(const char* type, const Case& given) {
  ObjectPtr<idl::MotionCommand> said;
  try_component<SeeingPartner>({.type = type}, [&](SeeingPartner& test) {
    test.scan(given.seen);
    if (given.has_goal) test.drive_to(given.goal_x, given.goal_y, 0.2);
    said = test.at_origin(0.0, 0.0, given.speed);
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
  CHECK(said_by(type, {.seen = wall(0.6, -0.5, 0.5), .has_goal = false, .speed = 0.3})->kind() ==
        idl::MotionKind::NORMAL);
}

TEST_CASE("within reach of the goal Dwa and NdPlus leave coming to rest to others, if the robot can stop",
          "[testing][dwa][nd]") {
  const char* const type = GENERATE("orca.Dwa", "orca.NdPlus");
  const Case arriving{.goal_x = 0.1, .speed = 0.3};
  CHECK(said_by(type, arriving)->kind() == idl::MotionKind::DONTCARE);
  Case before_a_wall = arriving;
  before_a_wall.seen = wall(0.33, -0.5, 0.5);
  CHECK(said_by(type, before_a_wall)->kind() == idl::MotionKind::NORMAL);
  CHECK(said_by(type, before_a_wall)->speed() < 0.5 * arriving.speed);
}

TEST_CASE("before a wall Dwa turns without driving on", "[testing][dwa]") {
  const auto said = said_by("orca.Dwa", {.seen = wall(0.27, -0.6, 0.6)});
  CHECK(said->speed() == 0.0);
  CHECK(std::abs(said->turn_rate()) > 0.1);
}

TEST_CASE("NdPlus drives slower where something is near on both sides of its way", "[testing][nd]") {
  const Shape corridor = [](double angle) {
    return std::min(kFar, 0.35 / std::max(1e-9, std::abs(std::sin(angle))));
  };
  const auto free = said_by("orca.NdPlus", {});
  const auto between = said_by("orca.NdPlus", {.seen = corridor});
  CHECK(free->speed() == Approx(0.4));
  CHECK(between->speed() < 0.3);
  CHECK(between->speed() > 0.05);
  CHECK(between->turn_rate() == Approx(0.0).margin(0.05));
}

TEST_CASE("NdPlus leads past the edge of a wall that is nearest to the goal", "[testing][nd]") {
  const auto left = said_by("orca.NdPlus", {.seen = wall(1.0, -0.5, 0.5), .goal_y = 1.0});
  const auto right = said_by("orca.NdPlus", {.seen = wall(1.0, -0.5, 0.5), .goal_y = -1.0});
  CHECK(left->turn_rate() > 0.3);
  CHECK(right->turn_rate() == Approx(-left->turn_rate()).margin(0.1));
}

TEST_CASE("in a closed room NdPlus turns on the spot, to the side of the goal", "[testing][nd]") {
  const Shape closed = [](double) { return 0.8; };
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
  const auto before = said_by("orca.PotentialField", {.seen = wall(0.7, -0.5, 0.5)});
  const auto at = said_by("orca.PotentialField", {.seen = wall(0.3, -0.5, 0.5)});
  CHECK(free->speed() == Approx(0.4));
  CHECK(before->speed() < free->speed());
  CHECK(before->speed() > 0.0);
  CHECK(at->speed() == 0.0);
}

TEST_CASE("without a goal PotentialField speaks only where something repels the robot", "[testing][field]") {
  CHECK(said_by("orca.PotentialField", {.has_goal = false})->kind() == idl::MotionKind::DONTCARE);
  CHECK(said_by("orca.PotentialField", {.seen = wall(0.5, -0.5, 0.5), .has_goal = false})->kind() ==
        idl::MotionKind::NORMAL);
}
