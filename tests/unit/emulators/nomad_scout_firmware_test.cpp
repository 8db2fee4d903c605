// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes are those of the protocol's description, written out by hand.
#include <catch2/catch.hpp>

#include <numbers>

#include "orca/emulators/nomad_scout_firmware.hpp"
#include "robot_line.hpp"

using namespace orca;
using namespace std::chrono_literals;
using emulators::NomadScoutFirmware;
using emulators::NomadScoutSettings;
using hw::test::Bytes;
using hw::test::hex;
using hw::test::joined;
using hw::test::text_of;

namespace {

constexpr const char* kGetState = "01 02 00 07 0A 5C";
constexpr const char* kTurnLeft = "01 08 00 05 69 00 5F 00 00 00 D6 5C";  // VM 105, 95
constexpr const char* kGoBack = "01 08 00 05 32 80 32 80 00 00 72 5C";    // VM -50, -50
constexpr const char* kStopNow = "01 02 00 09 0C 5C";                     // ST
constexpr const char* kGoLimp = "01 02 00 0A 0D 5C";                      // LP
constexpr const char* kWatchFor5s = "01 03 00 12 05 1B 5C";               // CONF_TM 5
constexpr const char* kAskPosition = "01 02 00 15 18 5C";                 // GET_RC
constexpr const char* kFireSonars =                                       // CONF_SN, 60 ms
    "01 13 00 0F 0F 00 02 0F 01 0E 03 0D 04 0C 05 0B 06 0A 07 09 08 AA 5C";
constexpr const char* kNakAnswer = "01 02 00 08 0B 5C";

/// A Scout and its host.
struct ScoutLine : emulators::test::RobotLine<NomadScoutFirmware, NomadScoutSettings, 38400> {
  using RobotLine::RobotLine;
  std::string answer(const std::string& packet) { return RobotLine::answer(packet, 20ms); }
};

}  // namespace

TEST_CASE("the emulated Scout answers GS with its state, byte for byte", "[emulators][scout]") {
  ScoutLine scout;
  for (int i = 0; i < 16; ++i) scout.body.ranges[i] = 0.0254 * (20 + i);
  scout.answer(kFireSonars);
  scout.pass(1692ms);
  scout.body.pose = {0.3099, 0.0152, 5.2 * std::numbers::pi / 180.0};
  scout.body.measured = Twist2{0.254, 0.0, 0.0254 / 0.3452};
  scout.say(kGetState);  // 1712 ms after it was switched on
  CHECK(text_of(scout.pass(20ms)) ==
        "01 2C 00 07 14 15 16 17 18 19 1A 1B 1C 1D 1E 1F 20 21 22 23 00 00 00 7A 00 06 00 34 00 00 00 69 00 "
        "5F 00 00 00 00 00 03 B0 06 00 00 C8 D2 BB 5C");
}

TEST_CASE("the emulated Scout takes its line time for an answer, and none over TCP", "[emulators][scout]") {
  ScoutLine scout;
  scout.say(kGetState);
  CHECK(scout.pass(12ms).size() < 48);  // 48 bytes take 12.5 ms at 38400 baud
  CHECK(scout.pass(1ms).size() >= 1);
  scout.say(kGetState, 0);
  CHECK(scout.pass(1ms).size() == 48);
}

TEST_CASE("the emulated Scout understands nothing at another rate, and what it sends is not understood",
          "[emulators][scout]") {
  ScoutLine scout;
  scout.say(kGetState, 9600);
  CHECK(scout.pass(100ms).empty());
  scout.say(kGetState);
  scout.say("", 9600);
  const Bytes sent = scout.pass(20ms);
  CHECK(sent.size() == 48);
  CHECK(sent[0] != 0x01);
}

TEST_CASE("VM drives the emulated Scout: right wheel first, sign and magnitude", "[emulators][scout]") {
  ScoutLine scout;
  CHECK_FALSE(scout.firmware.has_power());
  CHECK(scout.answer(kTurnLeft).starts_with("01 2C 00 05 "));
  CHECK(scout.firmware.has_power());
  CHECK(scout.body.told.forward == Approx(0.254));
  CHECK(scout.body.told.turn_rate == Approx(0.0254 / 0.3452));
  scout.answer(kGoBack);
  CHECK(scout.body.told.forward == Approx(-0.127));
  CHECK(scout.body.told.turn_rate == 0.0);
}

TEST_CASE("ST stops the emulated Scout and keeps its power, and LP takes the power", "[emulators][scout]") {
  ScoutLine scout;
  scout.answer(kTurnLeft);
  CHECK(scout.answer(kStopNow).starts_with("01 2C 00 09 "));
  CHECK(scout.body.told == Twist2{});
  CHECK(scout.firmware.has_power());
  scout.answer(kTurnLeft);
  CHECK(scout.answer(kGoLimp).starts_with("01 2C 00 0A "));
  CHECK(scout.body.told == Twist2{});
  CHECK_FALSE(scout.firmware.has_power());
}

TEST_CASE("the emulated Scout's motion watchdog bites after its time, once, and any command feeds it",
          "[emulators][scout]") {
  ScoutLine scout;
  scout.answer(kTurnLeft);
  scout.pass(20s);
  CHECK_FALSE(scout.body.told == Twist2{});  // it is off after power-on
  CHECK(scout.answer(kWatchFor5s).starts_with("01 2C 00 12 "));
  scout.pass(4900ms);
  scout.answer(kAskPosition);
  scout.pass(4900ms);
  CHECK_FALSE(scout.body.told == Twist2{});
  scout.pass(200ms);
  CHECK(scout.body.told == Twist2{});
  scout.pass(20s);
  CHECK(scout.firmware.watchdog_stops() == 1);
}

TEST_CASE("the emulated Scout counts tenths of an inch and of a degree, and backward with a sign bit",
          "[emulators][scout]") {
  ScoutLine scout;
  scout.body.pose = {-0.0254, 153 * 0.00254, -std::numbers::pi / 2.0};
  CHECK(scout.answer(kAskPosition) == "01 0A 00 15 0A 80 99 00 8C 0A 00 00 D9 5C");  // -10, 153, 2700
}

TEST_CASE("the emulated Scout's position comes back to the other end after 16 bits", "[emulators][scout]") {
  ScoutLine scout;
  scout.body.pose = {32769 * 0.00254, 0.0, 0.0};  // two beyond the end
  CHECK(scout.answer(kAskPosition) == "01 0A 00 15 FF FF 00 00 00 00 00 00 1E 5C");
}

TEST_CASE("DP and DA define the emulated Scout's position and heading, from which it goes on",
          "[emulators][scout]") {
  ScoutLine scout;
  scout.body.pose = {3.0, 4.0, 0.0};
  scout.answer("01 06 00 0C 00 00 00 00 13 5C");  // DP 0, 0
  scout.answer("01 06 00 1E 84 03 00 00 AC 5C");  // DA 900, 0
  CHECK(scout.answer(kAskPosition) == "01 0A 00 15 00 00 00 00 84 03 00 00 A7 5C");
  scout.body.pose.x += 0.254;  // ahead, which is along y now
  CHECK(scout.answer(kAskPosition) == "01 0A 00 15 00 00 64 00 84 03 00 00 0B 5C");
}

TEST_CASE("the emulated Scout fires its sonars one after the other in the order of the list",
          "[emulators][scout]") {
  ScoutLine scout;
  for (int i = 0; i < 16; ++i) scout.body.ranges[i] = 1.0;  // 39 inches
  const auto heard = [&] { return scout.answer("01 02 00 14 17 5C").substr(12, 47); };
  CHECK(heard() == "FF FF FF FF FF FF FF FF FF FF FF FF FF FF FF FF");
  scout.say(kFireSonars);
  scout.pass(120ms);  // 0 and 2
  CHECK(heard() == "27 FF 27 FF FF FF FF FF FF FF FF FF FF FF FF FF");
  scout.pass(40ms);  // 15
  CHECK(heard() == "27 FF 27 FF FF FF FF FF FF FF FF FF FF FF FF 27");
  scout.body.ranges.clear();
  scout.answer("01 13 00 0F 00 FF FF FF FF FF FF FF FF FF FF FF FF FF FF FF FF 13 5C");  // off
  CHECK_FALSE(scout.firmware.fires_sonars());
  scout.pass(2s);
  CHECK(heard() == "27 FF 27 FF FF FF FF FF FF FF FF FF FF FF FF 27");
}

TEST_CASE("a list of sonars that is empty fires none", "[emulators][scout]") {
  ScoutLine scout;
  const std::string answered =
      scout.answer("01 13 00 0F 0F FF FF FF FF FF FF FF FF FF FF FF FF FF FF FF FF 22 5C");
  CHECK(answered.starts_with("01 2C 00 0F "));
  CHECK_FALSE(scout.firmware.fires_sonars());
}

TEST_CASE("the emulated Scout tells its bumpers with the low byte first", "[emulators][scout]") {
  ScoutLine scout;
  scout.body.pressed = 0x0201;
  CHECK(scout.answer("01 02 00 1B 1E 5C").starts_with("01 09 00 1B 01 02 00 "));
}

TEST_CASE("the emulated Scout tells its velocities, right wheel first", "[emulators][scout]") {
  ScoutLine scout;
  scout.answer(kTurnLeft);
  CHECK(scout.answer("01 02 00 16 19 5C") == "01 08 00 16 69 00 5F 00 00 00 E7 5C");
}

TEST_CASE("PR moves each wheel of the emulated Scout by its distance, with the speed of SP",
          "[emulators][scout]") {
  ScoutLine scout;
  scout.answer("01 08 00 02 64 00 64 00 00 00 D3 5C");  // SP 100, 100
  scout.answer("01 08 00 03 90 01 90 01 00 00 2E 5C");  // PR 400, 400
  scout.pass(10s);
  CHECK(scout.body.told == Twist2{});
  CHECK(scout.body.pose.x == Approx(1.016).margin(0.001));
}

TEST_CASE("MV gives each axis of the emulated Scout a mode of its own", "[emulators][scout]") {
  ScoutLine scout;
  scout.answer("01 0E 00 2B 01 00 64 00 01 00 64 00 00 00 00 00 04 5C");  // both wheels 100
  CHECK(scout.body.told.forward == Approx(0.254));
  scout.answer(
      "01 0E 00 2B 00 00 00 00 01 00 00 00 00 00 00 00 3B 5C");  // the left one 0, the right one goes on
  CHECK(scout.body.told.forward == Approx(0.127));
  CHECK(scout.body.told.turn_rate == Approx(0.254 / 0.3452));
}

TEST_CASE("WS is answered when the emulated Scout stands, or when its time is over", "[emulators][scout]") {
  ScoutLine scout;
  const std::string wait = "01 06 00 1F 01 01 00 05 2D 5C";
  scout.answer("01 08 00 02 64 00 64 00 00 00 D3 5C");
  scout.answer("01 08 00 03 90 01 90 01 00 00 2E 5C");  // takes 4 s
  scout.say(wait);
  CHECK(scout.pass(3900ms).empty());
  CHECK(text_of(scout.pass(200ms)).starts_with("01 2C 00 1F "));
  scout.answer(kTurnLeft);  // it never stands
  scout.say(wait);
  CHECK(scout.pass(4900ms).empty());
  CHECK(text_of(scout.pass(200ms)).starts_with("01 2C 00 1F "));
}

TEST_CASE(
    "the emulated Scout answers what it does not understand with NAK, and a spoiled packet with nothing",
    "[emulators][scout]") {
  ScoutLine scout;
  CHECK(scout.answer("01 02 00 63 66 5C") == kNakAnswer);
  CHECK(scout.answer("01 03 00 05 69 72 5C") == kNakAnswer);  // VM that is cut short
  CHECK(scout.answer("01 02 00 07 0B 5C").empty());
  CHECK(scout.answer(kGetState).starts_with("01 2C 00 07 "));
}

TEST_CASE("half a packet is forgotten by the emulated Scout after a while", "[emulators][scout]") {
  ScoutLine scout;
  scout.say("01 F0 00 05");
  scout.pass(600ms);
  CHECK(scout.answer(kGetState).starts_with("01 2C 00 07 "));
}

TEST_CASE("packets reach the emulated Scout byte by byte, glued, and in garbage", "[emulators][scout]") {
  ScoutLine scout;
  for (const std::uint8_t byte : hex(kTurnLeft)) {
    scout.firmware.take(Bytes{byte}, 38400, scout.now);
    scout.pass(1ms);
  }
  CHECK(scout.body.told.forward == Approx(0.254));
  scout.firmware.take(joined({hex("5C 00 01"), hex(kGoBack), hex(kGetState), hex("FF")}), 38400, scout.now);
  CHECK(scout.firmware.commands() == std::vector<int>{5, 5, 7});
  CHECK(scout.body.told.forward == Approx(-0.127));
}

TEST_CASE("an emulated Scout that is switched off and on is limp, silent for a while, and as new",
          "[emulators][scout]") {
  ScoutLine scout;
  scout.answer(kWatchFor5s);
  scout.answer(kFireSonars);
  scout.answer(kTurnLeft);
  scout.firmware.reset(scout.now);
  CHECK(scout.body.told == Twist2{});
  CHECK_FALSE(scout.firmware.has_power());
  CHECK(scout.firmware.watchdog() == 0s);
  CHECK_FALSE(scout.firmware.fires_sonars());
  CHECK(scout.answer(kGetState).empty());
  scout.pass(2s);
  CHECK(scout.answer("01 02 00 1B 1E 5C") == "01 09 00 1B 00 00 00 14 00 00 00 39 5C");  // its clock: 20 ms
}

TEST_CASE("ZR makes the emulated Scout as new, and is answered late", "[emulators][scout]") {
  ScoutLine scout;
  scout.answer(kTurnLeft);
  scout.say("01 02 00 0D 10 5C");
  CHECK(scout.body.told == Twist2{});
  CHECK(scout.pass(900ms).empty());
  CHECK(text_of(scout.pass(200ms)).starts_with("01 2C 00 0D "));
}
