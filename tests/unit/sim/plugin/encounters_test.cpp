// SPDX-License-Identifier: GPL-3.0-or-later
// Who met whom: what a run keeps of a robot and the people who walk about.
#include "encounters.hpp"

#include <catch2/catch.hpp>

#include "scout.hpp"
#include "shared_world.hpp"

using namespace orca;
using namespace orca::sim;
using namespace orca::sim::test;

namespace {

TimePoint at(double seconds) { return TimePoint{} + from_seconds(seconds); }

// A robot of 0.2 m radius in the origin, and a person of 0.25 m whose rim is so far away.
Encounters::Now robot(double seconds, double speed) { return {at(seconds), Circle{{}, 0.2}, speed}; }
Person anna(double gap, double speed = 1.0) { return {"anna", {0.45 + gap, 0.0}, 0.25, speed}; }

// A Scout on the line that anna walks along, there and back in 8 s.
std::vector<Scene::Encounter> encounters_in_8_s(double y, double forward, double stops = 0.0) {
  WorldModel model{"walk", {}, {}};
  model.walkers.push_back({.name = "anna", .track = {{-2, 2}, {2, 2}}, .start = Duration{0}, .stops = stops});
  SharedWorld world(World(std::move(model), {.seed = 1, .realism = Realism::ideal}), "", TimePoint{});
  const RobotId id = world.add_robot("dewey", scout(), {0.0, y, 0.0}, kTruthPeriod).value();
  world.keep_motion(id);
  REQUIRE(world.command(id, {.velocity = {.forward = forward}}, TimePoint{}));
  for (int i = 1; i <= 80; ++i) (void)world.advance(id, at(0.1 * i));
  return world.encounters(id);
}

}  // namespace

TEST_CASE("an encounter begins at 0.3 m, keeps the least gap with the speeds then, and ends at 0.35 m",
          "[sim][people]") {
  Encounters encounters;
  encounters.look(anna(0.31), robot(1.0, 0.5));
  CHECK(encounters.all().empty());
  encounters.look(anna(0.2, 1.2), robot(2.0, 0.5));
  encounters.look(anna(0.1, 1.1), robot(3.0, 0.4));
  encounters.look(anna(0.33), robot(4.0, 0.3));
  encounters.look(anna(0.15), robot(5.0, 0.2));
  REQUIRE(encounters.all().size() == 1);
  const Scene::Encounter first = encounters.all()[0];
  CHECK(first.begin == at(2.0));
  CHECK(first.person == "anna");
  CHECK(first.gap_m == Approx(0.1));
  CHECK(first.robot_speed == 0.4);
  CHECK(first.person_speed == 1.1);
  CHECK_FALSE(first.touched);
  encounters.look(anna(0.36), robot(6.0, 0.2));
  encounters.look(anna(0.25), robot(7.0, 0.1));
  CHECK(encounters.all().size() == 2);
}

TEST_CASE("a touch makes an encounter one, with the speeds just before, and nearer looks do not change it",
          "[sim][people]") {
  Encounters encounters;
  encounters.look(anna(0.1), robot(1.0, 0.4));
  encounters.touch({"dewey", at(2.0), "anna", 0.3, 1.2}, at(2.0));
  encounters.look(anna(-1e-6, 0.0), robot(3.0, 0.0));
  REQUIRE(encounters.all().size() == 1);
  CHECK(encounters.all()[0].touched);
  CHECK(encounters.all()[0].gap_m == 0.0);
  CHECK(encounters.all()[0].robot_speed == 0.3);
  CHECK(encounters.all()[0].person_speed == 1.2);
}

TEST_CASE("a person who walks into a robot that stands is told from a robot that runs into her",
          "[sim][people]") {
  const auto stood = encounters_in_8_s(2.0, 0.0);
  REQUIRE_FALSE(stood.empty());
  CHECK(stood[0].touched);
  CHECK(stood[0].robot_speed == 0.0);
  CHECK(stood[0].person_speed == Approx(1.0));
  const auto drove = encounters_in_8_s(2.0, -0.3, 0.6);
  REQUIRE_FALSE(drove.empty());
  CHECK(drove[0].touched);
  CHECK(drove[0].robot_speed == Approx(0.3).margin(0.01));
  CHECK(drove[0].person_speed == 0.0);
}

TEST_CASE("a person who walks by within 0.3 m is met, one farther away is not", "[sim][people]") {
  const auto near = encounters_in_8_s(2.0 - 0.25 - 0.205 - 0.2, 0.0);
  REQUIRE(near.size() == 2);  // There and back.
  CHECK_FALSE(near[0].touched);
  CHECK(near[0].gap_m == Approx(0.2).margin(0.002));
  CHECK(encounters_in_8_s(2.0 - 0.25 - 0.205 - 0.32, 0.0).empty());
}
