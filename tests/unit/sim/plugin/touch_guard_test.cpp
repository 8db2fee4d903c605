// SPDX-License-Identifier: GPL-3.0-or-later
#include "touch_guard.hpp"

#include <catch2/catch.hpp>

#include "shipped.hpp"

using namespace orca;
using namespace orca::sim;
using namespace orca::sim::test;

namespace {

constexpr TimePoint kStart{};

// A robot that drives, and what its guard makes of what it senses.
struct Guarded {
  explicit Guarded(RobotModel of) : model(std::move(of)), motion({.max_speed = 1.0}, std::chrono::hours{1}) {}

  // Returns why the base does not go on straight ahead; empty: it does.
  std::string after(const SharedWorld::Inbox& inbox, double speed = 0.3) {
    idl::MotionCommand ahead;
    ahead.kind(idl::NORMAL);
    ahead.speed(speed);
    const Status started = motion.command(ahead, kStart);
    if (!started.ok()) return started.error().text();
    guard.look(inbox);
    const Status again = motion.command(ahead, kStart);
    return again.ok() ? "" : again.error().text();
  }

  RobotModel model;
  hw::MotionHW motion;
  TouchGuard guard{model, motion};
};

SharedWorld::Inbox touch_of(const std::string& what) {
  SharedWorld::Inbox inbox;
  inbox.contacts.push_back({{"Dewey", kStart, what, 0.3}, {}});
  return inbox;
}

SharedWorld::Inbox press_of(const RobotModel& model, std::size_t segment) {
  SharedWorld::Inbox inbox;
  BumperReading reading{kStart, std::vector<bool>(model.bumpers.at(0).count), {}};
  reading.pressed[segment] = true;
  inbox.bumper.emplace_back(0, reading);
  return inbox;
}

}  // namespace

TEST_CASE("a base with bumpers stands by what they feel, not by what the simulator knows", "[sim][touch]") {
  Guarded scout(shipped("nomad_scout"));
  CHECK(scout.after(touch_of("a wall")).empty());
  CHECK_THAT(scout.after(press_of(scout.model, 0)), Catch::Contains("its bumper \"front\" is pressed"));
}

TEST_CASE("a base without bumpers stands at any touch", "[sim][touch]") {
  RobotModel model = shipped("nomad_scout");
  model.bumpers.clear();
  Guarded scout(model);
  CHECK_THAT(scout.after(touch_of("a wall")), Catch::Contains("it touched a wall"));
}

TEST_CASE("a bumper behind the Pioneer holds it back from going backwards only", "[sim][touch]") {
  Guarded pioneer(shipped("pioneer_2dx"));
  REQUIRE(pioneer.model.bumpers.at(0).count == 10);
  CHECK(pioneer.after(press_of(pioneer.model, 7)).empty());
  CHECK_THAT(pioneer.after(press_of(pioneer.model, 7), -0.3),
             Catch::Contains("its bumper \"rear\" is pressed"));
}
