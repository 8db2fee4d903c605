// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes are those of the interface's specification, written out by hand.
#include <catch2/catch.hpp>

#include <numbers>

#include "orca/emulators/create2_firmware.hpp"
#include "robot_line.hpp"

using namespace orca;
using namespace std::chrono_literals;
using emulators::Create2Firmware;
using emulators::Create2Mode;
using emulators::Create2Settings;
using hw::test::Bytes;
using hw::test::text_of;

namespace {

constexpr const char* kStart = "80";
constexpr const char* kSafe = "83";
constexpr const char* kFull = "84";
constexpr const char* kAhead = "91 00 C8 00 C8";     // both wheels 200 mm/s
constexpr const char* kBackward = "91 FF 38 FF 38";  // both -200 mm/s
constexpr const char* kStand = "91 00 00 00 00";

/// A Create 2 and its host.
struct CreateLine : emulators::test::RobotLine<Create2Firmware, Create2Settings, 115200> {
  using RobotLine::RobotLine;
  std::string answer(const std::string& bytes) { return RobotLine::answer(bytes, 10ms); }
  void open(const std::string& mode = kSafe) {
    say(kStart);
    say(mode);
    pass(1ms);
  }
};

}  // namespace

TEST_CASE("the emulated Create hears nothing before Start, which leads to passive mode",
          "[emulators][create2]") {
  CreateLine create;
  CHECK(create.answer("8E 23").empty());
  CHECK(create.firmware.mode() == Create2Mode::off);
  create.say(kStart);
  CHECK(create.answer("8E 23") == "01");  // packet 35, the mode
  create.say(kSafe);
  CHECK(create.answer("8E 23") == "02");
  create.say(kFull);
  CHECK(create.answer("8E 23") == "03");
  create.say("AD");  // Stop
  CHECK(create.answer("8E 23").empty());
}

TEST_CASE("the emulated Create drives in safe and full mode only", "[emulators][create2]") {
  CreateLine create;
  create.say(kStart);
  create.say(kAhead);
  CHECK(create.body.told == Twist2{});
  create.say(GENERATE(as<std::string>{}, "82", "83", "84"));
  create.say(kAhead);
  CHECK(create.body.told.forward == Approx(0.2));
  create.say(kStart);
  CHECK(create.body.told == Twist2{});
}

TEST_CASE("DRIVE DIRECT tells the emulated Create the right wheel first", "[emulators][create2]") {
  CreateLine create;
  create.open();
  create.say("91 00 C8 00 64");  // right 200, left 100
  CHECK(create.body.told.forward == Approx(0.15));
  CHECK(create.body.told.turn_rate == Approx(0.1 / 0.235));
  create.say("91 7F FF FF 38");  // limited to 500; left -200
  CHECK(create.body.told.forward == Approx(0.15));
  CHECK(create.body.told.turn_rate == Approx(0.7 / 0.235));
}

TEST_CASE("DRIVE tells the emulated Create a speed and an arc", "[emulators][create2]") {
  CreateLine create;
  create.open();
  create.say("89 FF 38 01 F4");  // the manual's: -200 mm/s, 500 mm
  CHECK(create.body.told.forward == Approx(-0.2));
  CHECK(create.body.told.turn_rate == Approx(-0.4).epsilon(0.01));
  create.say("89 00 C8 80 00");  // straight on
  CHECK(create.body.told.forward == Approx(0.2));
  CHECK(create.body.told.turn_rate == 0.0);
  create.say("89 00 C8 00 01");  // on the spot to the left
  CHECK(create.body.told.forward == 0.0);
  CHECK(create.body.told.turn_rate == Approx(0.4 / 0.235));
  create.say("89 00 C8 FF FF");  // to the right
  CHECK(create.body.told.turn_rate == Approx(-0.4 / 0.235));
}

TEST_CASE("DRIVE PWM gives the emulated Create's wheels a part of their greatest speed",
          "[emulators][create2]") {
  CreateLine create;
  create.open();
  create.say("92 00 FF 00 FF");
  CHECK(create.body.told.forward == Approx(0.5));
}

TEST_CASE("the emulated Create sends a stream every 15 ms, whose bytes have the sum 0",
          "[emulators][create2]") {
  CreateLine create;
  create.say(kStart);
  create.body.no_floor = 0x02;
  create.say("94 02 0A 0D");  // packets 10 and 13
  CHECK(create.pass(14ms).empty());
  CHECK(text_of(create.pass(4ms)) == "13 04 0A 01 0D 00 D1");
  CHECK(create.pass(15ms).size() == 7);
  create.say("96 00");  // pause
  CHECK(create.pass(100ms).empty());
  create.say("96 01");
  CHECK(create.pass(18ms).size() == 7);
}

TEST_CASE("a stream of the emulated Create that its line cannot carry has gaps", "[emulators][create2]") {
  Create2Settings settings;
  settings.baud = 19200;
  CreateLine create(settings);
  create.say(kStart, 19200);
  create.say("94 01 64", 19200);  // all packets: 84 bytes, 43.75 ms
  const std::size_t count = create.pass(1s).size();
  CHECK(count > 15 * 84);
  CHECK(count < 23 * 84);
}

TEST_CASE("the emulated Create answers a list with the data alone, high byte first", "[emulators][create2]") {
  CreateLine create;
  create.say(kStart);
  CHECK(create.answer("95 03 16 19 1A") == "39 D0 07 D0 09 C4");  // 14800 mV, 2000 and 2500 mAh
  CHECK(create.pass(1s).empty());
  CHECK(create.firmware.commands() == std::vector<int>{128, 149});
}

TEST_CASE("the groups of the emulated Create have the sizes of the manual", "[emulators][create2]") {
  CreateLine create;
  create.say(kStart);
  const auto size = [&](const std::string& group) {
    create.say("8E " + group);
    return create.pass(20ms).size();
  };
  CHECK(size("00") == 26);
  CHECK(size("01") == 10);
  CHECK(size("02") == 6);
  CHECK(size("03") == 10);
  CHECK(size("04") == 14);
  CHECK(size("05") == 12);
  CHECK(size("06") == 52);
  CHECK(size("64") == 80);
  CHECK(size("65") == 28);
  CHECK(size("6A") == 12);
  CHECK(size("6B") == 9);
}

TEST_CASE("the emulated Create counts its wheels' turns, back through 0", "[emulators][create2]") {
  CreateLine create;
  create.open();
  create.say(kAhead);
  create.pass(1131ms);  // 0.2262 m: a turn of a wheel of 72 mm
  create.say(kStand);
  CHECK(create.answer("95 02 2B 2C") == "01 FD 01 FD");  // 509
  create.say("91 00 C8 FF 38");                          // on the spot to the left
  create.pass(1131ms);
  create.say(kStand);
  CHECK(create.answer("95 02 2B 2C") == "00 00 03 FA");  // left 0, right 1018
  create.say(kBackward);
  create.pass(1131ms);
  create.say(kStand);
  CHECK(create.answer("8E 2B") == "FE 03");  // -509
}

TEST_CASE("the emulated Create tells distance and angle since it was asked last", "[emulators][create2]") {
  CreateLine create;
  create.open();
  create.say(kBackward);
  create.pass(1s);
  create.say(kStand);
  CHECK(create.answer("8E 13") == "FF 38");  // -200 mm
  CHECK(create.answer("8E 13") == "00 00");
  create.body.pose.yaw = wrapped(create.body.pose.yaw + 0.5 * std::numbers::pi);
  create.pass(1ms);
  CHECK(create.answer("8E 14") == "00 5A");
}

TEST_CASE("bumps, drops, cliffs, currents and chargers of the emulated Create are where the manual says",
          "[emulators][create2]") {
  CreateLine create;
  create.say(kStart);
  create.body.pressed = 2;
  CHECK(create.answer("8E 07") == "02");  // left
  create.body.lifted = true;
  CHECK(create.answer("8E 07") == "0E");
  create.body.no_floor = 0x09;
  CHECK(create.answer("95 04 09 0A 0B 0C") == "01 00 00 01");
  create.body.stalled = true;
  CHECK(create.answer("8E 0E") == "18");
  create.firmware.connect_charger(true);
  CHECK(create.answer("95 02 15 22") == "02 01");
}

TEST_CASE("the emulated Create leaves safe mode when a wheel drops, at a cliff ahead, and at a charger",
          "[emulators][create2]") {
  CreateLine create;
  create.open();
  create.say(kAhead);
  const int what = GENERATE(0, 1, 2);
  create.body.lifted = what == 0;
  create.body.no_floor = what == 1 ? 4 : 0;
  create.firmware.connect_charger(what == 2);
  create.pass(1ms);
  CHECK(create.firmware.mode() == Create2Mode::passive);
  CHECK(create.body.told == Twist2{});
  CHECK(create.firmware.safety_stops() == 1);
}

TEST_CASE("the emulated Create may leave a cliff backward, and heeds none in full mode",
          "[emulators][create2]") {
  CreateLine create;
  create.open();
  create.body.no_floor = 4;
  create.say(kBackward);
  create.pass(100ms);
  CHECK(create.body.told.forward == Approx(-0.2));
  create.say(kFull);
  create.say(kAhead);
  create.pass(100ms);
  CHECK(create.body.told.forward == Approx(0.2));
}

TEST_CASE("the emulated Create has no watchdog", "[emulators][create2]") {
  CreateLine create;
  create.open();
  create.say(kAhead);
  create.pass(20s);
  CHECK(create.body.told.forward == Approx(0.2));
}

TEST_CASE("the emulated Create understands nothing at another rate until BAUD has set it",
          "[emulators][create2]") {
  CreateLine create;
  create.say(kStart, 19200);
  CHECK(create.firmware.mode() == Create2Mode::off);
  create.say("80 81 07");  // Start, 19200 baud
  create.say("83", 19200);
  CHECK(create.firmware.mode() == Create2Mode::safe);
  create.say("8E 23", 115200);
  CHECK(create.pass(10ms).empty());
}

TEST_CASE("commands with data of any length are passed over by the emulated Create", "[emulators][create2]") {
  CreateLine create;
  create.say(kStart);
  create.say("8C 00 02 48 20 4A 20");                             // a song of two notes
  create.say("8B 00 80 FF");                                      // lights
  create.say("A7 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");  // schedule
  create.say("8D 00");                                            // play
  CHECK(create.answer("8E 23") == "01");
  CHECK(create.firmware.commands() == std::vector<int>{128, 140, 139, 167, 141, 142});
}

TEST_CASE("an emulated Create that was reset is off, prints a text and is as new", "[emulators][create2]") {
  CreateLine create;
  create.open();
  create.say("94 01 07");
  create.say(kAhead);
  create.pass(1s);
  create.say("07");
  CHECK(create.body.told == Twist2{});
  CHECK(create.pass(1900ms).empty());
  create.say(kStart);  // it does not listen yet
  const Bytes text = create.pass(200ms);
  CHECK(std::string(text.begin(), text.end()).starts_with("bl-start\r\n"));
  CHECK(create.firmware.mode() == Create2Mode::off);
  create.say(kStart);
  CHECK(create.answer("8E 2B") == "00 00");
  CHECK(create.pass(1s).empty());  // no stream
}
