// SPDX-License-Identifier: GPL-3.0-or-later
// A hardware container with a driver that fails: nothing gets out of it, and the motors stand.
#include <catch2/catch.hpp>

#include <stdexcept>

#include "fake_scout.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::HardwareState;

namespace {

Status cable_is_off() { return fail(Code::unavailable, "the cable is off"); }

// Uses the robot and makes it drive, as far as its fault allows.
void use_and_drive(RunningScout& robot) {
  robot.scout.acquire();
  CHECK(eventually(robot.executive, [&] {
    return robot.scout.state() == HardwareState::active || robot.scout.state() == HardwareState::fault;
  }));
  (void)robot.scout.command(*turn(0.25, 0.5));
}

// Returns the place of a line in the diary; the number of lines if it is not there.
long place_of(const Diary& diary, const std::string& line) {
  const auto lines = diary.lines();
  return std::find(lines.begin(), lines.end(), line) - lines.begin();
}

}  // namespace

EXECUTIVE_CASE("a device that cannot be opened is a fault with the driver's reason", "[hw][fault]") {
  RunningScout robot(executive, {{"open", cable_is_off}});
  REQUIRE(robot.gets(HardwareState::fault));
  CHECK(robot.scout.fault() == "the cable is off");
  CHECK(robot.diary.has("log: the cable is off"));
  robot.scout.acquire();
  sleep(executive, 20ms);
  CHECK(robot.scout.state() == HardwareState::fault);
  CHECK_FALSE(robot.diary.has("start"));
}

EXECUTIVE_CASE("a device that cannot be started is a fault", "[hw][fault]") {
  RunningScout robot(executive, {{"start", cable_is_off}});
  use_and_drive(robot);
  REQUIRE(robot.gets(HardwareState::fault));
  CHECK(robot.scout.fault() == "the cable is off");
  CHECK_FALSE(robot.diary.has("-> Active"));
  CHECK_FALSE(robot.diary.has("drive 0.5 0.25"));
}

EXECUTIVE_CASE(
    "when a device fails while the base moves, the motors are commanded to stand and the device is stopped",
    "[hw][fault]") {
  std::atomic<bool> cable_on{true};
  RunningScout robot(executive, {{"poll", [&] { return cable_on ? ok() : cable_is_off(); }}});
  use_and_drive(robot);
  REQUIRE(robot.notes("drive 0.5 0.25"));
  cable_on = false;
  REQUIRE(robot.gets(HardwareState::fault));
  CHECK(robot.scout.fault() == "the cable is off");
  CHECK(place_of(robot.diary, "drive 0 0") < place_of(robot.diary, "-> Fault"));
  CHECK(place_of(robot.diary, "stop") < place_of(robot.diary, "-> Fault"));
  CHECK(place_of(robot.diary, "drive 0 0") < place_of(robot.diary, "stop"));
}

EXECUTIVE_CASE("after a fault nothing moves: commands are refused, and new users change nothing",
               "[hw][fault]") {
  std::atomic<bool> cable_on{false};
  RunningScout robot(executive, {{"poll", [&] { return cable_on ? ok() : cable_is_off(); }}});
  REQUIRE(robot.gets(HardwareState::fault));
  cable_on = true;
  robot.scout.acquire();
  robot.scout.release();
  robot.scout.acquire();
  sleep(executive, 100ms);
  CHECK(robot.scout.state() == HardwareState::fault);
  const Status refused = robot.scout.command(*turn(0.25, 0.5));
  REQUIRE_FALSE(refused.ok());
  CHECK_THAT(refused.error().text(), Contains("Fault"));
  CHECK_FALSE(robot.diary.has("start"));
}

EXECUTIVE_CASE("the first failure stays the reason of the fault", "[hw][fault]") {
  RunningScout robot(executive,
                     {{"drive", [] { return fail(Code::unavailable, "the motors do not answer"); }},
                      {"stop", []() -> Status { throw std::runtime_error("the cable burns"); }}});
  use_and_drive(robot);
  REQUIRE(robot.gets(HardwareState::fault));
  CHECK(robot.scout.fault() == "the motors do not answer");
}

TEST_CASE("any exception of a driver, in any function, is a fault with its text and nothing more",
          "[hw][fault]") {
  const std::string function = GENERATE("open", "start", "poll", "drive", "stop", "close");
  CAPTURE(function);
  run_on_each(all_executives(), [&](Executive& executive) {
    RunningScout robot(executive, {{function, []() -> Status { throw std::runtime_error("smoke"); }}});
    use_and_drive(robot);
    sleep(executive, 10ms);
    robot.scout.release();
    sleep(executive, 60ms);
    robot.end();
    CHECK(robot.scout.state() == HardwareState::fault);
    CHECK_THAT(robot.scout.fault(), Contains("the hardware plugin threw") && Contains("smoke"));
  });
}

EXECUTIVE_CASE("a driver may throw something other than a std::exception", "[hw][fault]") {
  RunningScout robot(executive, {{"poll", []() -> Status { throw 7; }}});
  REQUIRE(robot.gets(HardwareState::fault));
  CHECK_THAT(robot.scout.fault(), Contains("the hardware plugin threw the int"));
}

EXECUTIVE_CASE("a driver that throws while the base moves leaves standing motors and a closed device",
               "[hw][fault]") {
  std::atomic<bool> burns{false};
  RunningScout robot(executive, {{"poll", [&]() -> Status {
                                    if (burns) throw std::runtime_error("smoke");
                                    return ok();
                                  }}});
  use_and_drive(robot);
  REQUIRE(robot.notes("drive 0.5 0.25"));
  burns = true;
  REQUIRE(robot.gets(HardwareState::fault));
  CHECK(robot.diary.has("drive 0 0"));
  CHECK(robot.diary.has("stop"));
  robot.end();
  CHECK(robot.diary.lines().back() == "close");
  CHECK(robot.scout.state() == HardwareState::fault);
}
