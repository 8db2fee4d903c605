// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes are those of the protocol's description, written out by hand.
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "pioneer_line.hpp"

using namespace orca;
using namespace std::chrono_literals;
using emulators::P2osSettings;
using emulators::test::kAhead;
using emulators::test::kEnable;
using emulators::test::kStop;
using emulators::test::kSync0;
using emulators::test::kSync1;
using emulators::test::kSync2;
using emulators::test::OpenPioneer;
using emulators::test::PioneerLine;
using hw::test::Bytes;
using hw::test::text_of;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

}  // namespace

TEST_CASE("the emulated Pioneer echoes the handshake, and tells its three names with the last step",
          "[emulators][p2os]") {
  P2osSettings settings;
  settings.name = "Pioneer2";
  PioneerLine line(settings);
  CHECK(line.answer(kSync0) == "FA FB 03 00 00 00");
  CHECK(line.answer(kSync1) == "FA FB 03 01 00 01");
  CHECK(line.answer(kSync2) ==
        "FA FB 19 02 50 69 6F 6E 65 65 72 32 00 50 69 6F 6E 65 65 72 00 70 32 64 78 00 DD 7C");
}

TEST_CASE("a step of the handshake that is out of turn is refused with FF", "[emulators][p2os]") {
  PioneerLine line;
  CHECK(line.answer(kSync1) == "FA FB 03 FF 00 FF");
  CHECK(line.answer(kSync0) == "FA FB 03 00 00 00");
  CHECK(line.answer(kSync2) == "FA FB 03 FF 00 FF");
}

TEST_CASE("the emulated Pioneer is opened with and without an argument, behind what a modem would be told",
          "[emulators][p2os]") {
  PioneerLine line;
  line.say("57 4D 53 32 0D");  // "WMS2"
  for (const char* const step : {kSync0, kSync1, kSync2})
    CHECK_THAT(line.answer(step), Catch::StartsWith(std::string(step).substr(0, 5)));
  const std::string open = GENERATE(as<std::string>{}, kSync1, "FA FB 06 01 3B 01 00 02 3B");
  INFO(open);
  line.say(open);
  CHECK(line.firmware.is_open());
  (void)line.information();
}

TEST_CASE("the information of an emulated Pioneer, byte for byte", "[emulators][p2os]") {
  OpenPioneer line;
  line.body.pose = {0.84, -0.084, std::numbers::pi / 2};
  line.body.pressed = 0x0203;  // two in front, one behind
  line.body.stalled = true;
  // x 1000 counts, y -100 in 15 bits, heading 1024; at rest, 12.7 V; stalls and bumpers; motors on.
  CHECK(text_of(line.information()) ==
        "FA FB 1B 32 E8 03 9C 7F 00 04 00 00 00 00 7F 05 07 00 00 01 00 00 00 00 00 00 00 00 C0 0A");
}

TEST_CASE("a Pioneer that knows whether it is charged appends its voltage and the state of the charger",
          "[emulators][p2os]") {
  OpenPioneer line;
  const std::size_t plain = line.information().size();
  line.body.charged = true;
  const Bytes charged = line.information();
  REQUIRE(charged.size() == plain + 3);
  CHECK(charged[plain - 2] == 127);  // 12.7 V, low byte first, before the checksum
  CHECK(charged[plain - 1] == 0);
  CHECK(charged[plain] == 1);
  line.body.charged = false;
  CHECK(line.information()[plain] == 0);
}

TEST_CASE("sonars are told eight at a time when they are switched on", "[emulators][p2os]") {
  OpenPioneer line;
  line.body.ranges = {{0, 1.0}, {9, 0.5}};
  line.say("FA FB 06 1C 3B 01 00 1D 3B");
  Bytes first = line.information();
  if (first[22] == 0) first = line.information();  // one that had begun before
  const Bytes second = line.information();
  CHECK(first[22] == 8);
  CHECK(second[22] == 8);
  const Bytes& with_zero = first[23] == 0 ? first : second;
  const Bytes& with_nine = first[23] == 0 ? second : first;
  CHECK(text_of(std::span(with_zero).subspan(23, 6)) == "00 93 0E 01 E1 48");  // 3731 counts; none: 5 m
  CHECK(text_of(std::span(with_nine).subspan(26, 3)) == "09 4A 07");           // 1866 counts
}

TEST_CASE("VEL, RVEL and VEL2 drive the emulated Pioneer, and only with power", "[emulators][p2os]") {
  PioneerLine line;
  for (const char* const step : {kSync0, kSync1, kSync2, kSync1}) (void)line.answer(step);
  line.say(kAhead);
  CHECK(line.body.told == Twist2{});
  line.say(kEnable);
  CHECK(line.body.told.forward == Approx(0.2));
  line.say("FA FB 06 0B 1B C8 00 D3 1B");  // VEL -200: a magnitude behind 1B
  CHECK(line.body.told.forward == Approx(-0.2));
  line.say("FA FB 06 15 1B 1E 00 33 1B");  // RVEL -30
  CHECK(line.body.told.turn_rate == Approx(-30 * kDegree));
  line.say("FA FB 06 20 3B 0A 09 2A 44");  // VEL2: right 10, left 9
  CHECK(line.body.told.forward == Approx(0.19));
  CHECK(line.body.told.turn_rate == Approx(0.02 * 5.6 / 2));
  line.say(kStop);
  CHECK(line.body.told == Twist2{});
  CHECK(line.firmware.has_power());
}

TEST_CASE("the watchdog of an emulated Pioneer bites after two seconds, and PULSE feeds it",
          "[emulators][p2os]") {
  OpenPioneer line;
  line.say(kAhead);
  line.pass_alive(5s);
  CHECK(line.body.told.forward == Approx(0.2));
  (void)line.pass(1600ms);
  CHECK(line.body.told == Twist2{});
  CHECK(line.firmware.watchdog_stops() == 1);
}

TEST_CASE("SETO makes the emulated Pioneer count from where it is, also with half an argument",
          "[emulators][p2os]") {
  OpenPioneer line;
  line.body.pose = {2.0, 1.0, 1.0};
  line.say(GENERATE(as<std::string>{}, "FA FB 03 07 00 07", "FA FB 04 07 3B 07 3B"));
  const Bytes told = line.information();
  CHECK(text_of(std::span(told).subspan(4, 6)) == "00 00 00 00 00 00");
}

TEST_CASE("MOVE drives the emulated Pioneer its way, and it stands then", "[emulators][p2os]") {
  OpenPioneer line;
  line.say("FA FB 06 08 1B 2C 01 34 1C");  // MOVE -300
  CHECK(line.firmware.is_open());
  (void)line.pass(200ms);
  CHECK(line.body.told.forward < -0.1);
  line.pass_alive(5s);
  CHECK(std::abs(line.body.pose.x + 0.3) < 0.01);
  CHECK(line.body.told == Twist2{});
}

TEST_CASE("HEAD turns the emulated Pioneer to a heading, DHEAD by an angle, the shorter way",
          "[emulators][p2os]") {
  OpenPioneer line;
  line.say("FA FB 06 0C 3B 5A 00 66 3B");  // HEAD 90
  line.pass_alive(5s);
  CHECK(std::abs(line.body.pose.yaw - 90 * kDegree) < 0.02);
  line.say("FA FB 06 0D 1B 2D 00 3A 1B");  // DHEAD -45
  line.pass_alive(5s);
  CHECK(std::abs(line.body.pose.yaw - 45 * kDegree) < 0.03);
  CHECK(line.body.told == Twist2{});
}

// A maker's library sends one command for each axis.
TEST_CASE("translation and rotation of the emulated Pioneer are two axes, and a command changes only its own",
          "[emulators][p2os]") {
  OpenPioneer line;
  SECTION("a turn rate of 0 does not end a distance, sent before or behind it") {
    const bool before = GENERATE(true, false);
    if (before) line.say("FA FB 06 15 3B 00 00 15 3B");  // RVEL 0
    line.say("FA FB 06 08 3B F4 01 FC 3C");              // MOVE 500
    if (!before) line.say("FA FB 06 15 3B 00 00 15 3B");
    line.pass_alive(5s);
    CHECK(line.body.pose.x == Approx(0.5).margin(0.01));
  }
  SECTION("it drives on while it turns to a heading") {
    line.say(kAhead);                        // VEL 200
    line.say("FA FB 06 0C 3B 5A 00 66 3B");  // HEAD 90
    CHECK(line.body.told.forward == Approx(0.2));
    line.pass_alive(5s);
    CHECK(std::abs(line.body.pose.yaw - 90 * kDegree) < 0.02);
    CHECK(line.body.told.forward == Approx(0.2));
  }
  SECTION("a distance is that of its path") {
    line.say("FA FB 06 15 3B 1E 00 33 3B");  // RVEL 30
    line.say("FA FB 06 08 3B F4 01 FC 3C");  // MOVE 500
    double path = 0.0;
    for (int i = 0; i < 5000; ++i) {
      path += 0.001 * line.body.told.forward;
      if (i % 500 == 0) line.say(kSync0);
      (void)line.pass(1ms);
    }
    CHECK(path == Approx(0.5).margin(0.01));
    CHECK(line.body.told.turn_rate == Approx(30 * kDegree));
  }
  SECTION("a velocity ends the distance or heading of its own axis") {
    line.say("FA FB 06 08 3B F4 01 FC 3C");  // MOVE 500
    line.say("FA FB 06 0C 3B 5A 00 66 3B");  // HEAD 90
    (void)line.pass(200ms);
    line.say("FA FB 06 0B 3B 00 00 0B 3B");  // VEL 0
    CHECK(line.body.told.forward == 0.0);
    CHECK(line.body.told.turn_rate > 0.1);
    line.say("FA FB 06 15 3B 00 00 15 3B");  // RVEL 0
    (void)line.pass(200ms);
    CHECK(line.body.told == Twist2{});
  }
}

TEST_CASE("CONFIG is answered with what the emulated Pioneer is", "[emulators][p2os]") {
  OpenPioneer line;
  line.say("FA FB 06 12 3B 01 00 13 3B");
  const std::string sent = text_of(line.pass(400ms));
  // Class, subclass and serial number; then 500 deg/s and 2200 mm/s.
  CHECK_THAT(sent,
             Catch::Contains("20 50 69 6F 6E 65 65 72 00 70 32 64 78 00 4F 52 43 41 00 00 F4 01 98 08"));
  // The name; 100 ms between packets, 9600 baud.
  CHECK_THAT(sent, Catch::Contains("4F 72 63 61 5F 45 6D 75 00 64 00 00"));
  // No RevCount; the watchdog has 2000 ms.
  CHECK_THAT(sent, Catch::Contains("6E 00 00 00 D0 07"));
}

TEST_CASE("bumpers of the emulated Pioneer raise a stall when BUMPSTALL says so", "[emulators][p2os]") {
  OpenPioneer line;
  line.body.pressed = 0x0001;
  const Bytes before = line.information();
  CHECK((before[15] & 1) == 0);
  CHECK((before[16] & 1) == 0);
  line.say("FA FB 06 2C 3B 03 00 2F 3B");  // BUMPSTALL 3
  (void)line.pass(150ms);
  const Bytes told = line.information();
  CHECK((told[15] & 1) == 1);
  CHECK((told[16] & 1) == 1);
}

TEST_CASE("HOSTBAUD changes the rate of the emulated Pioneer, and a reset takes it back",
          "[emulators][p2os]") {
  OpenPioneer line;
  line.say("FA FB 06 32 3B 02 00 34 3B");  // 38400
  line.say(kAhead);                        // at the old rate
  CHECK(line.body.told == Twist2{});
  line.say(kAhead, 38400);
  CHECK(line.body.told.forward == Approx(0.2));
  line.say("FA FB 03 FD 00 FD", 38400);  // reset
  CHECK(line.body.told == Twist2{});
  CHECK_FALSE(line.firmware.is_open());
  CHECK(line.answer(kSync0) == "FA FB 03 00 00 00");
}

TEST_CASE("CLOSE sets the configured rate of the emulated Pioneer again, so that it is found a second time",
          "[emulators][p2os]") {
  OpenPioneer line;
  line.say("FA FB 06 32 3B 02 00 34 3B");  // HOSTBAUD 38400
  line.say(kSync2, 38400);                 // CLOSE
  CHECK_FALSE(line.firmware.is_open());
  CHECK(line.answer(kSync0) == "FA FB 03 00 00 00");
  line.open();
  CHECK(line.firmware.is_open());
}

TEST_CASE("the red button of the emulated Pioneer takes the power, and is told", "[emulators][p2os]") {
  OpenPioneer line;
  line.say(kAhead);
  line.firmware.press_button(true);
  CHECK(line.body.told == Twist2{});
  line.say(kEnable);
  CHECK_FALSE(line.firmware.has_power());
  (void)line.pass(150ms);
  CHECK(line.information()[19] == 0x20);
}

TEST_CASE("a packet with a wrong checksum, or cut short by another one, is not obeyed", "[emulators][p2os]") {
  OpenPioneer line;
  line.say("FA FB 06 0B 3B C8 00 D3 3C");
  line.say("FA FB 00");
  line.say("FA FA FB 06 04");
  CHECK(line.body.told == Twist2{});
  line.say(kAhead);
  CHECK(line.body.told.forward == Approx(0.2));
}
