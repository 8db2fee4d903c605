// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes are those of docs/hardware/xr4000.md, written out by hand.
#include <catch2/catch.hpp>

#include "orca/emulators/xr4000_firmware.hpp"
#include "robot_line.hpp"

using namespace orca;
using namespace std::chrono_literals;
using emulators::Xr4000Firmware;
using emulators::Xr4000Settings;
using hw::test::Bytes;
using hw::test::hex;
using hw::test::text_of;

namespace {

constexpr const char* kHello = "58 52 01 00 01 01 64 D1";
constexpr const char* kGetState = "58 52 00 00 02 DE EC";
constexpr const char* kFeed = "58 52 00 00 04 18 8C";  // N_ResetMotionTimer
constexpr const char* kLimpAfter500ms = "58 52 04 00 05 F4 01 00 00 D3 71";
constexpr const char* kAskSonar = "58 52 00 00 07 7B BC";
constexpr const char* kAskBumper = "58 52 00 00 09 B5 5D";
// Velocity mode with x -100 mm/s, y 300 mm/s, both at 500 mm/s^2, and rotation 250 mrad/s at 2000 mrad/s^2.
constexpr const char* kGoLeftAndTurn =
    "58 52 1B 00 03 04 9C FF FF FF F4 01 00 00 04 2C 01 00 00 F4 01 00 00 04 FA 00 00 00 D0 07 00 00 80 7D";
constexpr const char* kStopHard =  // velocity mode with 0 at 1500 mm/s^2 and 5000 mrad/s^2
    "58 52 1B 00 03 04 00 00 00 00 DC 05 00 00 04 00 00 00 00 DC 05 00 00 04 00 00 00 00 88 13 00 00 7C 9E";
constexpr const char* kStopMode =
    "58 52 1B 00 03 05 00 00 00 00 00 00 00 00 05 00 00 00 00 00 00 00 00 05 00 00 00 00 00 00 00 00 74 B2";
constexpr const char* kOnlyAhead =  // mode none for x and rotation; y 200 mm/s at 1000 mm/s^2
    "58 52 1B 00 03 00 00 00 00 00 00 00 00 00 04 C8 00 00 00 E8 03 00 00 00 00 00 00 00 00 00 00 00 B6 B6";
constexpr const char* kFastest =  // 2^31 - 1, -2^31 and 2^31 - 1, at 2^31 - 1, -2^31 and 0
    "58 52 1B 00 03 04 FF FF FF 7F FF FF FF 7F 04 00 00 00 80 00 00 00 80 04 FF FF FF 7F 00 00 00 00 24 A5";
constexpr const char* kMoveBy =  // position mode
    "58 52 1B 00 03 02 00 00 00 00 F4 01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 8F 65";
constexpr const char* kAxesTaken = "58 52 01 00 83 00 BF BC";
constexpr const char* kAxesNotReady = "58 52 01 00 83 F6 66 33";  // -10
constexpr const char* kInvalidAxes = "58 52 01 00 83 FD 0D 82";   // -3

/// An XR4000 and its host, which hears everything that it sends.
struct XrLine : emulators::test::RobotLine<Xr4000Firmware, Xr4000Settings, 115200> {
  using RobotLine::RobotLine;
  std::string answer(const std::string& frame) { return RobotLine::answer(frame, 20ms); }
};

}  // namespace

TEST_CASE("the emulated XR4000 says who it is", "[emulators][xr4000]") {
  XrLine robot;
  CHECK(robot.answer(kHello) == "58 52 03 00 81 00 01 78 D2 A7");
}

TEST_CASE("the emulated XR4000 answers with its state, byte for byte", "[emulators][xr4000]") {
  XrLine robot;
  robot.now += 123456ms;
  robot.body.pose = {1.25, 0.5, 0.785};
  robot.body.measured = Twist2{0.3, 0.1, -0.05};
  CHECK(
      robot.answer(kGetState) ==
      "58 52 1E 00 82 00 00 40 E2 01 00 0C FE FF FF E2 04 00 00 11 03 00 00 9C FF FF FF 2C 01 00 00 CE FF FF "
      "FF 23 6F");
}

TEST_CASE("the emulated XR4000 takes its line time for an answer, and none over TCP", "[emulators][xr4000]") {
  XrLine robot;
  robot.say(kGetState);
  CHECK(robot.pass(3ms).size() < 37);  // 37 bytes take 3.2 ms at 115200 baud
  CHECK(robot.pass(1ms).size() >= 1);
  robot.say(kGetState, 0);
  CHECK(robot.pass(1ms).size() == 37);
  robot.say(kGetState, 9600);
  CHECK(robot.pass(100ms).empty());
}

TEST_CASE("the emulated XR4000's axes take up speed no faster than their accelerations",
          "[emulators][xr4000]") {
  XrLine robot;
  CHECK_FALSE(robot.firmware.has_power());
  robot.say(kGoLeftAndTurn);
  robot.pass(100ms);
  CHECK(robot.firmware.has_power());
  CHECK(robot.body.told.forward == Approx(0.05));  // 100 ms at 0.5 m/s^2
  CHECK(robot.body.told.left == Approx(0.05));
  CHECK(robot.body.told.turn_rate == Approx(0.2));  // 100 ms at 2 rad/s^2
  robot.pass(600ms);
  CHECK(robot.body.told.forward == Approx(0.3));
  CHECK(robot.body.told.left == Approx(0.1));
  CHECK(robot.body.told.turn_rate == Approx(0.25));
  CHECK(robot.answer(kStopHard) == kAxesTaken);
  robot.pass(80ms);
  CHECK(robot.body.told.forward == Approx(0.15));  // 100 ms at 1.5 m/s^2
  robot.pass(110ms);
  CHECK(robot.body.told == Twist2{});
  CHECK(robot.firmware.has_power());
}

TEST_CASE("stop mode brakes the emulated XR4000 at 1 m/s^2, and mode none leaves an axis as it is",
          "[emulators][xr4000]") {
  XrLine robot;
  robot.say(kGoLeftAndTurn);
  robot.pass(1s);
  robot.say(kOnlyAhead);
  robot.pass(1s);
  CHECK(robot.body.told.forward == Approx(0.2));
  CHECK(robot.body.told.left == Approx(0.1));
  robot.say(kStopMode);
  robot.pass(100ms);
  CHECK(robot.body.told.forward == Approx(0.1));
  robot.pass(200ms);
  CHECK(robot.body.told == Twist2{});
}

TEST_CASE("no axis of the emulated XR4000 exceeds its limits, whatever it is told", "[emulators][xr4000]") {
  XrLine robot;
  robot.say(kFastest);
  robot.pass(5s);
  CHECK(robot.body.told.left == Approx(-1.5));
  CHECK(robot.body.told.forward == 0.0);    // a negative acceleration is none
  CHECK(robot.body.told.turn_rate == 0.0);  // and so is 0
}

TEST_CASE("the emulated XR4000 refuses modes that it does not have, and moves no axis then",
          "[emulators][xr4000]") {
  XrLine robot;
  CHECK(robot.answer(kMoveBy) == kInvalidAxes);
  CHECK_FALSE(robot.firmware.has_power());
}

TEST_CASE("the emulated XR4000's axes go limp when nobody resets its motion timer", "[emulators][xr4000]") {
  XrLine robot;
  CHECK(robot.answer(kLimpAfter500ms) == "58 52 01 00 85 00 19 16");
  CHECK(robot.firmware.timeout() == 500ms);
  robot.say(kGoLeftAndTurn);
  for (int i = 0; i < 20; ++i) {
    robot.answer(kFeed);
    robot.pass(100ms);
  }
  CHECK(robot.body.told.forward == Approx(0.3));
  CHECK(robot.answer(kFeed) == "58 52 01 00 84 00 28 25");
  robot.pass(470ms);
  CHECK(robot.firmware.has_power());
  robot.answer(kGoLeftAndTurn);  // which feeds nothing
  robot.pass(20ms);
  CHECK_FALSE(robot.firmware.has_power());
  CHECK(robot.body.told == Twist2{});
  CHECK(robot.firmware.limp_stops() == 1);
}

TEST_CASE("without a time-out the emulated XR4000 drives on", "[emulators][xr4000]") {
  XrLine robot;
  robot.say(kGoLeftAndTurn);
  robot.pass(1min);
  CHECK(robot.body.told.forward == Approx(0.3));
  CHECK(robot.firmware.limp_stops() == 0);
}

TEST_CASE("axes of the emulated XR4000 that are not ready stop and refuse", "[emulators][xr4000]") {
  XrLine robot;
  robot.say(kGoLeftAndTurn);
  robot.pass(1s);
  const int status = GENERATE(1, 2, 4);
  robot.firmware.set_status(static_cast<std::uint8_t>(status));
  CHECK(robot.body.told == Twist2{});
  CHECK(robot.answer(kGoLeftAndTurn) == kAxesNotReady);
  CHECK(robot.body.told == Twist2{});
  CHECK(hex(robot.answer(kGetState))[6] == status);
  robot.firmware.set_status(8);  // which is no hindrance
  CHECK(robot.answer(kGoLeftAndTurn) == kAxesTaken);
}

TEST_CASE("the emulated XR4000's sonars read whole inches set after set, and nothing beyond 299",
          "[emulators][xr4000]") {
  XrLine robot;
  robot.body.ranges = {{0, 0.508}, {8, 1.0}, {46, 7.5946}, {47, 7.7}};
  const Bytes sent = hex(robot.answer(kAskSonar));
  REQUIRE(sent.size() == 104);
  const auto reading = [&](std::size_t number) { return sent[6 + 2 * number] + 256 * sent[7 + 2 * number]; };
  CHECK(reading(0) == 508);
  CHECK(reading(1) == 65535);
  CHECK(reading(8) == 991);  // 39 inches
  CHECK(reading(46) == 7595);
  CHECK(reading(47) == 65535);
}

TEST_CASE("a touch ahead of the emulated XR4000 is one of its front door", "[emulators][xr4000]") {
  XrLine robot;
  robot.body.pressed = 1;
  CHECK(
      robot.answer(kAskBumper) ==
      "58 52 3D 00 89 00 00 00 00 00 01 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 "
      "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 04 "
      "53");
}

TEST_CASE("the emulated XR4000's integrator is where it was set, and goes on from there",
          "[emulators][xr4000]") {
  XrLine robot;
  robot.body.pose = {3.0, 4.0, 0.0};
  // 1000, -2000, 1571
  CHECK(robot.answer("58 52 0C 00 06 E8 03 00 00 30 F8 FF FF 23 06 00 00 87 ED") ==
        "58 52 01 00 86 00 4A 43");
  robot.body.pose = {3.5, 4.0, 0.0};  // 0.5 m ahead, which is to the left in the integrator's frame
  const Bytes sent = hex(robot.answer(kGetState));
  CHECK(text_of(Bytes(sent.begin() + 11, sent.begin() + 23)) == "F4 01 00 00 30 F8 FF FF 23 06 00 00");
}

TEST_CASE("the emulated XR4000's agent knows no other request, and none that is cut short",
          "[emulators][xr4000]") {
  XrLine robot;
  CHECK(robot.answer("58 52 00 00 30 CF FA") == "58 52 01 00 B0 FC EA C2");  // -4
  CHECK(hex(robot.answer("58 52 01 00 03 04 A3 E7")).at(5) == 0xFE);         // -2
  CHECK(robot.answer("58 52 01 00 82 FA DB C1").empty());                    // an answer
}

TEST_CASE("when the library fails, the emulated XR4000's agent says what it returns", "[emulators][xr4000]") {
  XrLine robot;
  robot.firmware.fail_with(-6);
  CHECK(robot.answer(kGetState) == "58 52 01 00 82 FA DB C1");
}

TEST_CASE("the emulated XR4000 that is switched off and on stands, and begins at 0", "[emulators][xr4000]") {
  XrLine robot;
  robot.answer(kLimpAfter500ms);
  robot.say(kGoLeftAndTurn);
  robot.pass(300ms);
  robot.firmware.reset(robot.now);
  CHECK(robot.body.told == Twist2{});
  CHECK_FALSE(robot.firmware.has_power());
  robot.pass(1s);
  CHECK(robot.answer(kGetState).empty());
  robot.pass(980ms);
  CHECK(robot.answer(kGetState) != "");
  CHECK(robot.firmware.timeout() == Duration{0});
}
