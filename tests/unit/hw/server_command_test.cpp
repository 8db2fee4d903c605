// SPDX-License-Identifier: GPL-3.0-or-later
// Motion commands through a hardware server.
#include <catch2/catch.hpp>

#include "patient_executives.hpp"
#include "scout_base.hpp"

using namespace orca;
using namespace orca::test;
using hw::HardwareState;

namespace {

SendServerEndpoint& motion_port(ScoutBase& base) {
  return static_cast<SendServerEndpoint&>(base.bench.peer().endpoint("MotionCommandSend"));
}

}  // namespace

EXECUTIVE_CASE("a motion command starts an idle base and is carried out", "[hw][server][motion]") {
  ScoutBase base(executive);
  base.run();
  REQUIRE(base.client.motion.send(turn(0.25, 0.5)).ok());
  CHECK(base.robot.notes("drive 0.5 0.25"));
  CHECK(base.robot.scout.state() == HardwareState::active);
}

PATIENT_CASE("a base that gets no more commands stops, and is released a little later",
             "[hw][server][motion]") {
  ScoutBase base(executive);
  base.run();
  REQUIRE(base.client.motion.send(turn(0.25, 0.5)).ok());
  CHECK(base.robot.notes("drive 0.5 0.25"));
  CHECK(base.robot.notes("drive 0 0"));
  CHECK(base.robot.scout.state() == HardwareState::active);
  CHECK(base.robot.notes("stop"));
  CHECK(base.gets(HardwareState::ready));
}

EXECUTIVE_CASE("commands that keep coming keep the base moving", "[hw][server][motion]") {
  ScoutBase base(executive);
  base.run();
  REQUIRE(base.client.motion.send(turn(0.25, 0.5)).ok());
  REQUIRE(base.robot.notes("drive 0.5 0.25"));
  if (!executive.is_virtual()) return;  // in real time a busy machine may be late
  for (int lap = 0; lap < 20; ++lap) {
    CHECK(base.client.motion.send(turn(0.25, 0.5)).ok());
    sleep(executive, 100ms);
  }
  CHECK_FALSE(base.robot.diary.has("drive 0 0"));
  CHECK_FALSE(base.robot.diary.has("stop"));
}

EXECUTIVE_CASE("a full stop stops a moving base at once and releases it", "[hw][server][motion]") {
  ScoutBase base(executive);
  base.run();
  REQUIRE(base.client.motion.send(turn(0.25, 0.5)).ok());
  REQUIRE(base.robot.notes("drive 0.5 0.25"));
  const TimePoint sent = executive.now();
  REQUIRE(base.client.motion.send(full_stop()).ok());
  CHECK(base.robot.notes("drive 0 0"));
  if (executive.is_virtual()) CHECK(executive.now() - sent < 10ms);
  CHECK(base.gets(HardwareState::ready));
}

EXECUTIVE_CASE("a full stop to a base that stands does not even start it", "[hw][server][motion]") {
  ScoutBase base(executive);
  base.run();
  REQUIRE(base.client.motion.send(full_stop()).ok());
  CHECK(eventually(executive, [&] { return motion_port(base).counters().accepted == 1; }));
  sleep(executive, 50ms);
  CHECK_FALSE(base.robot.diary.has("start"));
}

EXECUTIVE_CASE("a full stop overrules a command that the base had no time to start for",
               "[hw][server][motion]") {
  ScoutBase base(executive);
  REQUIRE(base.client.motion.send(turn(0.25, 0.5)).ok());
  REQUIRE(base.client.motion.send(full_stop()).ok());
  base.run();
  sleep(executive, 50ms);
  CHECK_FALSE(base.robot.diary.has("drive 0.5 0.25"));
}

PATIENT_CASE("a command that waited longer for the hardware than a command may live is not carried out",
             "[hw][server][motion]") {
  ScoutBase base(executive, {{"start", [&] {
                                sleep(executive, kScoutCommandAge + 50ms);
                                return ok();
                              }}});
  base.run();
  REQUIRE(base.client.motion.send(turn(0.25, 0.5)).ok());
  REQUIRE(base.gets(HardwareState::active));
  sleep(executive, 50ms);
  CHECK_FALSE(base.robot.diary.has("drive 0.5 0.25"));
  REQUIRE(base.client.motion.send(turn(0.5, 0.25)).ok());
  CHECK(base.robot.notes("drive 0.25 0.5"));
}

EXECUTIVE_CASE(
    "a command that no base can carry out fails by itself: it starts no hardware and stops no server",
    "[hw][server][motion]") {
  ScoutBase base(executive);
  base.run();
  REQUIRE(base.client.motion.send(dont_care()).ok());
  CHECK(eventually(executive, [&] { return motion_port(base).counters().failed == 1; }));
  CHECK_FALSE(base.robot.diary.has("start"));
  REQUIRE(base.client.motion.send(turn(0.25, 0.5)).ok());
  CHECK(base.robot.notes("drive 0.5 0.25"));
  REQUIRE(base.client.motion.send(dont_care()).ok());
  CHECK(eventually(executive, [&] { return motion_port(base).counters().failed == 2; }));
  REQUIRE(base.client.motion.send(turn(0.5, 0.25)).ok());
  CHECK(base.robot.notes("drive 0.25 0.5"));
}

TEST_CASE("a base asks once about commands that no robot can carry out, and names their sender",
          "[hw][server][motion]") {
  run_on_each(virtual_executives(), [](Executive& executive) {
    ScoutBase base(executive);
    base.run();
    for (int i = 0; i < 3; ++i) {
      REQUIRE(base.client.motion.send(turn(90.0, 0.5)).ok());
      sleep(executive, 50ms);
    }
    const auto lines = base.bench.diary().lines();
    CHECK(std::ranges::count(lines,
                             "log: \"client\" commands a turn rate of 90 rad/s: did you mean degrees?") == 1);
  });
}
