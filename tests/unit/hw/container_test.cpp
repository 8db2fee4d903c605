// SPDX-License-Identifier: GPL-3.0-or-later
// The life cycle of a hardware container with a driver that works.
#include <catch2/catch.hpp>

#include "fake_scout.hpp"
#include "patient_executives.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::HardwareState;
using Lines = std::vector<std::string>;

EXECUTIVE_CASE("a container opens its device and does not start it before somebody uses it",
               "[hw][container]") {
  RunningScout robot(executive);
  CHECK(robot.gets(HardwareState::ready));
  sleep(executive, 20ms);
  CHECK(robot.diary.lines() == Lines{"-> Opening", "open", "-> Ready"});
}

EXECUTIVE_CASE("a container that is not simulated cannot be drawn", "[hw][container]") {
  RunningScout robot(executive);
  CHECK(robot.scout.drawable() == nullptr);
}

EXECUTIVE_CASE("the device runs from the first user to the last", "[hw][container]") {
  RunningScout robot(executive);
  REQUIRE(robot.gets(HardwareState::ready));
  robot.scout.acquire();
  CHECK(robot.gets(HardwareState::active));
  robot.scout.acquire();
  robot.scout.release();
  sleep(executive, 20ms);
  CHECK(robot.scout.state() == HardwareState::active);
  robot.scout.release();
  CHECK(robot.gets(HardwareState::ready));
  CHECK(robot.diary.lines() ==
        Lines{"-> Opening", "open", "-> Ready", "start", "-> Active", "stop", "-> Ready"});
}

EXECUTIVE_CASE("readings come only while the device runs, and old ones are forgotten when it stops",
               "[hw][container]") {
  RunningScout robot(executive);
  hw::SensorEndpoint& odometry = *robot.scout.sensors().at(1);
  std::atomic<int> seen{0};
  odometry.set_sink(&robot, [&](ObjectLoan reading) {
    ++seen;
    return std::move(reading).seal();
  });
  sleep(executive, 120ms);
  CHECK(seen == 0);
  robot.scout.acquire();
  CHECK(eventually(executive, [&] { return seen >= 3; }));
  CHECK(odometry.latest());
  robot.scout.release();
  CHECK(robot.gets(HardwareState::ready));
  CHECK_FALSE(odometry.latest());
  odometry.set_sink(&robot, nullptr);
}

EXECUTIVE_CASE("a command is carried out at once, and is zero when no other follows in time",
               "[hw][container]") {
  RunningScout robot(executive);
  robot.scout.acquire();
  REQUIRE(robot.gets(HardwareState::active));
  const TimePoint sent = executive.now();
  REQUIRE(robot.scout.command(*turn(0.25, 0.5)).ok());
  CHECK(robot.notes("drive 0.5 0.25"));
  if (executive.is_virtual()) CHECK(executive.now() - sent < 50ms);
  CHECK_FALSE(robot.diary.has("drive 0 0"));
  CHECK(robot.notes("drive 0 0"));
  CHECK(executive.now() - sent >= kScoutCommandAge);
  if (executive.is_virtual()) CHECK(executive.now() - sent <= kScoutCommandAge + 1ms);
  CHECK(robot.scout.wheels().expired_count() == 1);
  CHECK(robot.scout.state() == HardwareState::active);
}

EXECUTIVE_CASE(
    "a base that is held stops at once with a full stop, and takes commands again when it is let go",
    "[hw][container]") {
  RunningScout robot(executive);
  robot.scout.acquire();
  REQUIRE(robot.gets(HardwareState::active));
  REQUIRE(robot.scout.command(*turn(0.25, 0.5)).ok());
  REQUIRE(robot.notes("drive 0.5 0.25"));
  robot.scout.wheels().hold("emergency stop");
  CHECK(robot.scout.command(*full_stop()).ok());
  CHECK(robot.notes("drive 0 0"));
  CHECK(robot.scout.command(*turn(0.25, 0.5)).error().code == Code::unavailable);
  CHECK(robot.scout.state() == HardwareState::active);
  robot.scout.wheels().let_go();
  CHECK(robot.scout.command(*turn(0.5, 0.5)).ok());
  CHECK(robot.notes("drive 0.5 0.5"));
}

EXECUTIVE_CASE("a set-point is given to the motors once, however often it is commanded", "[hw][container]") {
  RunningScout robot(executive);
  robot.scout.acquire();
  REQUIRE(robot.gets(HardwareState::active));
  for (int i = 0; i < 10; ++i) {
    CHECK(robot.scout.command(*turn(0.25, 0.5)).ok());
    sleep(executive, 5ms);
  }
  const Lines lines = robot.diary.lines();
  CHECK(std::count(lines.begin(), lines.end(), "drive 0.5 0.25") == 1);
}

EXECUTIVE_CASE("a base that moves is stopped before the device is stopped", "[hw][container]") {
  RunningScout robot(executive);
  robot.scout.acquire();
  REQUIRE(robot.gets(HardwareState::active));
  REQUIRE(robot.scout.command(*turn(0.25, 0.5)).ok());
  REQUIRE(robot.notes("drive 0.5 0.25"));
  robot.scout.release();
  REQUIRE(robot.gets(HardwareState::ready));
  const Lines lines = robot.diary.lines();
  CHECK(Lines(lines.end() - 4, lines.end()) == Lines{"drive 0.5 0.25", "drive 0 0", "stop", "-> Ready"});
}

EXECUTIVE_CASE("a command of an earlier use is not carried out in the next", "[hw][container]") {
  RunningScout robot(executive);
  REQUIRE(robot.gets(HardwareState::ready));
  REQUIRE(robot.scout.wheels().command(*turn(0.25, 0.5), executive.now()).ok());
  robot.scout.acquire();
  REQUIRE(robot.gets(HardwareState::active));
  sleep(executive, 20ms);
  CHECK_FALSE(robot.diary.has("drive 0.5 0.25"));
}

EXECUTIVE_CASE("shutting down stops the motors and the device, and closes it", "[hw][container]") {
  RunningScout robot(executive);
  robot.scout.acquire();
  REQUIRE(robot.gets(HardwareState::active));
  REQUIRE(robot.scout.command(*turn(0.25, 0.5)).ok());
  REQUIRE(robot.notes("drive 0.5 0.25"));
  robot.end();
  const Lines lines = robot.diary.lines();
  CHECK(Lines(lines.end() - 5, lines.end()) == Lines{"drive 0 0", "stop", "-> Ready", "close", "-> Closed"});
}

EXECUTIVE_CASE("a command is refused unless the device runs, with its state", "[hw][container]") {
  RunningScout robot(executive);
  REQUIRE(robot.gets(HardwareState::ready));
  const Status refused = robot.scout.command(*turn(0.25, 0.5));
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::unavailable);
  CHECK_THAT(refused.error().text(), Contains("scout is Ready, not Active"));
  robot.end();
  CHECK_THAT(robot.scout.command(*turn(0.25, 0.5)).error().text(), Contains("Closed"));
}

TEST_CASE(
    "commands that come as the last one grows too old have not ceased, also if the last one is to stand",
    "[hw][container]") {
  const auto says_that_it_stands = [](const ObjectPtr<idl::MotionCommand>& last) {
    bool says = false;
    run_on({}, [&](Executive& executive) {
      RunningScout robot(executive);
      robot.scout.acquire();
      REQUIRE(robot.gets(HardwareState::active));
      REQUIRE(robot.scout.command(*turn(0.0, 0.5)).ok());
      sleep(executive, kScoutCommandAge + 5ms);
      if (last) REQUIRE(robot.scout.command(*last).ok());
      sleep(executive, 100ms);
      says = robot.diary.has("log: the base stands: no motion command for 200 ms");
    });
    return says;
  };
  CHECK(says_that_it_stands({}));
  CHECK_FALSE(says_that_it_stands(turn(0.0, 0.5)));
  CHECK_FALSE(says_that_it_stands(full_stop()));
}

TEST_CASE("hardware without motion refuses commands", "[hw][container]") {
  class Deaf final : public hw::HardwareContainer {
   public:
    using HardwareContainer::HardwareContainer;
    std::vector<orca::HardwareFault> prepare() override { return {}; }
    [[nodiscard]] idl::Robot description() const override { return {}; }

   private:
    Status poll() override { return ok(); }
    [[nodiscard]] TimePoint next_poll() const override { return kForever; }
    Status drive(const hw::DriveSetpoint&) override { return ok(); }
  };
  run_on({}, [](Executive& executive) {
    Diary diary;
    FakeHardwareHost host(executive, diary);
    Deaf laser(host);
    const Status refused = laser.command(*full_stop());
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == Code::failed_precondition);
  });
}

EXECUTIVE_CASE("observers of a container are woken when its state changes", "[hw][container]") {
  Strand watcher(executive, {"watcher", 0});
  RunningScout robot(executive);
  robot.scout.watch(watcher);
  const auto wait_for = [&](HardwareState state) {
    return watcher.wait_for(executive.now() + 5s, [&] { return robot.scout.state() == state; });
  };
  CHECK(wait_for(HardwareState::ready));
  robot.scout.acquire();
  CHECK(wait_for(HardwareState::active));
  robot.scout.release();
  CHECK(wait_for(HardwareState::ready));
  robot.end();
}

PATIENT_CASE("an observer that has gone is not woken", "[hw][container]") {
  Strand watcher(executive, {"watcher", 0});
  RunningScout robot(executive);
  robot.scout.watch(watcher);
  CHECK(watcher.wait_for(executive.now() + 5s, [&] { return robot.scout.state() == HardwareState::ready; }));
  robot.scout.watch(watcher, false);
  watcher.pause_until(executive.now());  // takes the wake for READY, if it came after the look that saw it
  robot.scout.acquire();
  int looks = 0;
  (void)watcher.wait_for(executive.now() + 300ms, [&] { return ++looks < 0; });
  CHECK(looks == 2);  // as the wait begins and as it ends: nobody woke it between
  CHECK(robot.scout.state() == HardwareState::active);
  robot.end();
}
