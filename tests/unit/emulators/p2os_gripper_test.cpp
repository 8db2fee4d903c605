// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes are written out by hand from the gripper's manual.
#include <catch2/catch.hpp>

#include <functional>
#include <utility>

#include "pioneer_line.hpp"

using namespace orca;
using namespace std::chrono_literals;
using emulators::GripperLook;
using emulators::GripperMove;
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
using Moves = std::vector<GripperMove>;

namespace {

constexpr const char* kOpenPaddles = "FA FB 06 21 3B 01 00 22 3B";
constexpr const char* kClosePaddles = "FA FB 06 21 3B 02 00 23 3B";
constexpr const char* kLiftUp = "FA FB 06 21 3B 04 00 25 3B";
constexpr const char* kPressure = "FA FB 06 21 3B 10 00 31 3B";
constexpr const char* kCarry = "FA FB 06 21 3B 11 00 32 3B";
constexpr const char* kUpOneSecond = "FA FB 06 24 3B 32 00 56 3B";    // GRIPPERVAL 50: times 20 ms
constexpr const char* kDownOneSecond = "FA FB 06 24 1B 32 00 56 1B";  // GRIPPERVAL -50
constexpr const char* kReset = "FA FB 03 FD 00 FD";
const Moves kHalt{GripperMove::stop, GripperMove::stop_lift};

/// A Pioneer with a gripper, whose paddles are open and whose lift is down, and its host.
struct GripperLine : PioneerLine {
  GripperLine() { body.look = GripperLook{.open = true, .down = true}; }
  /// Returns what the gripper was told since the last call.
  Moves told() { return std::exchange(body.gripper_moves, {}); }
  Moves told_by(const std::string& bytes) {
    say(bytes);
    return told();
  }
};

/// The same, when the host has opened it.
struct OpenGripper : GripperLine {
  OpenGripper() { open(); }
};

/// Returns the gripper's state and the inputs in an information packet without sonars.
std::string ports_of(const Bytes& information) {
  return text_of(std::span(information).subspan(24, 1)) + ' ' +
         text_of(std::span(information).subspan(26, 1));
}

/// Returns them of a robot whose gripper looks so.
std::string ports_at(const std::optional<GripperLook>& look) {
  OpenPioneer line;
  line.body.look = look;
  return ports_of(line.information());
}

}  // namespace

TEST_CASE("GRIPPER moves paddles and lift of the emulated Pioneer", "[emulators][p2os][gripper]") {
  OpenGripper line;
  CHECK(line.told().empty());
  CHECK(line.told_by(kOpenPaddles) == Moves{GripperMove::open});
  CHECK(line.told_by(kClosePaddles) == Moves{GripperMove::close});
  CHECK(line.told_by("FA FB 06 21 3B 03 00 24 3B") == Moves{GripperMove::stop});
  CHECK(line.told_by(kLiftUp) == Moves{GripperMove::up});
  CHECK(line.told_by("FA FB 06 21 3B 05 00 26 3B") == Moves{GripperMove::down});
  CHECK(line.told_by("FA FB 06 21 3B 06 00 27 3B") == Moves{GripperMove::stop_lift});
}

TEST_CASE("the emulated Pioneer stores, deploys and halts paddles and lift together",
          "[emulators][p2os][gripper]") {
  OpenGripper line;
  CHECK(line.told_by("FA FB 06 21 3B 07 00 28 3B") == Moves{GripperMove::close, GripperMove::up});
  CHECK(line.told_by("FA FB 06 21 3B 08 00 29 3B") == Moves{GripperMove::open, GripperMove::down});
  CHECK(line.told_by("FA FB 06 21 3B 0F 00 30 3B") == kHalt);
}

TEST_CASE("a gripper's commands that it does not know, and the pressure, move nothing",
          "[emulators][p2os][gripper]") {
  OpenGripper line;
  CHECK(line.told_by("FA FB 06 21 3B 00 00 21 3B").empty());  // GRIPPER 0
  CHECK(line.told_by("FA FB 06 21 3B 09 00 2A 3B").empty());  // GRIPPER 9
  CHECK(line.told_by("FA FB 06 21 1B 01 00 22 1B").empty());  // GRIPPER -1
  CHECK(line.told_by("FA FB 03 21 00 21").empty());           // without a number
  CHECK(line.told_by(kPressure).empty());
  CHECK(line.told_by(kUpOneSecond).empty());
}

TEST_CASE("no gripper's command does anything while the connection is not open",
          "[emulators][p2os][gripper]") {
  GripperLine line;
  CHECK(line.told_by(kClosePaddles).empty());
  for (const char* const step : {kSync0, kSync1, kSync2}) (void)line.answer(step);
  CHECK(line.told_by(kClosePaddles).empty());
  for (const char* const step : {kSync0, kSync1, kSync2, kSync1}) (void)line.answer(step);
  CHECK(line.told_by(kClosePaddles) == Moves{GripperMove::close});
  line.say(kSync2);  // CLOSE
  (void)line.told();
  CHECK(line.told_by(kClosePaddles).empty());
}

TEST_CASE("a carry moves the lift up or down for a time in steps of 20 ms", "[emulators][p2os][gripper]") {
  OpenGripper line;
  CHECK(line.told_by(kCarry).empty());
  CHECK(line.told_by(kUpOneSecond) == Moves{GripperMove::up});
  (void)line.pass(999ms);
  CHECK(line.told().empty());
  (void)line.pass(1ms);
  CHECK(line.told() == Moves{GripperMove::stop_lift});
  line.say(kCarry);
  CHECK(line.told_by(kDownOneSecond) == Moves{GripperMove::down});
  (void)line.pass(1s);
  CHECK(line.told() == Moves{GripperMove::stop_lift});
  line.pass_alive(3s);
  CHECK(line.told().empty());
}

TEST_CASE("a carry lasts 255 steps at most, and one of 0 steps does not begin",
          "[emulators][p2os][gripper]") {
  OpenGripper line;
  line.say(kCarry);
  CHECK(line.told_by("FA FB 06 24 3B 00 00 24 3B").empty());  // GRIPPERVAL 0
  line.say(kCarry);
  CHECK(line.told_by("FA FB 06 24 3B E8 03 0C 3E") == Moves{GripperMove::up});  // GRIPPERVAL 1000
  line.pass_alive(5s);
  CHECK(line.told().empty());
  (void)line.pass(100ms);
  CHECK(line.told() == Moves{GripperMove::stop_lift});
}

TEST_CASE("the time of a carry that does not follow at once is not used", "[emulators][p2os][gripper]") {
  OpenGripper line;
  line.say(kCarry);
  line.say(kSync0);  // PULSE
  CHECK(line.told_by(kUpOneSecond).empty());
  line.say(kCarry);
  line.firmware.reset(line.now);
  for (const char* const step : {kSync0, kSync1, kSync2, kSync1}) (void)line.answer(step);
  (void)line.told();
  CHECK(line.told_by(kUpOneSecond).empty());
  line.say(kCarry);
  CHECK(line.told_by(kUpOneSecond) == Moves{GripperMove::up});
  CHECK(line.told_by(kUpOneSecond).empty());
}

TEST_CASE("another command to the lift ends a carry, one to the paddles does not",
          "[emulators][p2os][gripper]") {
  OpenGripper line;
  line.say(kCarry);
  line.say(kUpOneSecond);
  line.say(kClosePaddles);
  (void)line.told();
  (void)line.pass(1s);
  CHECK(line.told() == Moves{GripperMove::stop_lift});
  line.say(kCarry);
  line.say(kUpOneSecond);
  line.say(kLiftUp);
  (void)line.told();
  (void)line.pass(1500ms);
  CHECK(line.told().empty());
}

TEST_CASE("CLOSE, a reset, the watchdog and the red button stop a gripper", "[emulators][p2os][gripper]") {
  struct End {
    const char* name;
    std::function<void(GripperLine&)> come;
  };
  const End end = GENERATE(values<End>({
      {"CLOSE", [](GripperLine& line) { line.say(kSync2); }},
      {"the reset that is commanded", [](GripperLine& line) { line.say(kReset); }},
      {"a reset", [](GripperLine& line) { line.firmware.reset(line.now); }},
      {"the watchdog", [](GripperLine& line) { (void)line.pass(2100ms); }},
      {"the button", [](GripperLine& line) { line.firmware.press_button(true); }},
  }));
  INFO(end.name);
  OpenGripper line;
  line.say(kClosePaddles);
  line.say(kCarry);
  line.say("FA FB 06 24 3B C8 00 EC 3B");  // GRIPPERVAL 200: 4 s
  (void)line.told();
  end.come(line);
  CHECK(line.told() == kHalt);
  line.pass_alive(5s);
  CHECK(line.told().empty());
}

TEST_CASE("a gripper moves again when the red button is released, and not before",
          "[emulators][p2os][gripper]") {
  OpenGripper line;
  line.firmware.press_button(true);
  (void)line.told();
  CHECK(line.told_by(kOpenPaddles).empty());
  line.say(kCarry);
  CHECK(line.told_by(kUpOneSecond).empty());
  line.firmware.press_button(false);
  CHECK(line.told().empty());
  CHECK(line.told_by(kOpenPaddles) == Moves{GripperMove::open});
}

TEST_CASE("neither the motors' power nor the wheels matter to a gripper", "[emulators][p2os][gripper]") {
  OpenGripper line;
  line.say(kAhead);
  CHECK(line.told_by(kOpenPaddles) == Moves{GripperMove::open});
  CHECK(line.body.told.forward == Approx(0.2));
  CHECK(line.told_by(kStop).empty());
  line.firmware.cut_power();
  CHECK(line.told().empty());
  CHECK(line.told_by(kClosePaddles) == Moves{GripperMove::close});
  CHECK(line.told_by(kEnable).empty());
}

TEST_CASE("the information of an emulated Pioneer with a gripper, byte for byte",
          "[emulators][p2os][gripper]") {
  OpenGripper line;
  // At rest, 12.7 V, motors on; paddles open, lift down; both switches at these ends are 0, those on the paddles 1.
  CHECK(text_of(line.information()) ==
        "FA FB 1B 32 00 00 00 00 00 00 00 00 00 00 7F 00 00 00 00 01 00 00 00 00 21 00 30 00 33 D0");
}

TEST_CASE("the information tells all that a gripper knows, a bit each", "[emulators][p2os][gripper]") {
  CHECK(ports_at(std::nullopt) == "00 00");
  CHECK(ports_at(GripperLook{}) == "00 33");
  CHECK(ports_at(GripperLook{.open = true}) == "01 32");
  CHECK(ports_at(GripperLook{.closed = true}) == "02 33");
  CHECK(ports_at(GripperLook{.paddles_move = true}) == "04 33");
  CHECK(ports_at(GripperLook{.up = true}) == "10 31");
  CHECK(ports_at(GripperLook{.down = true}) == "20 31");
  CHECK(ports_at(GripperLook{.lift_moves = true}) == "40 33");
  CHECK(ports_at(GripperLook{.outer_beam = true}) == "00 37");
  CHECK(ports_at(GripperLook{.inner_beam = true}) == "00 3B");
  CHECK(ports_at(GripperLook{.left_contact = true}) == "00 23");
  CHECK(ports_at(GripperLook{.right_contact = true}) == "00 13");
}

TEST_CASE("CONFIG tells kind 1 of a gripper, and 0 of none", "[emulators][p2os][gripper]") {
  const bool has_gripper = GENERATE(true, false);
  PioneerLine line;
  if (has_gripper) line.body.look = GripperLook{};
  line.open();
  line.say("FA FB 06 12 3B 01 00 13 3B");
  // 100 ms between packets, 9600 baud; the gripper; sonars in front and behind; low battery 11 V.
  CHECK_THAT(text_of(line.pass(400ms)), Catch::Contains(has_gripper ? "00 64 00 00 01 00 01 00 01 6E 00"
                                                                    : "00 64 00 00 00 00 01 00 01 6E 00"));
}

TEST_CASE("GRIPPERPACREQUEST gets one gripper packet, or one with each information packet, or no more",
          "[emulators][p2os][gripper]") {
  OpenGripper line;
  const std::string packet = "FA FB 06 E0 01 30 00 10 01";  // kind 1; the switches of an open gripper below
  const auto packets_in = [&](Duration time) {
    const std::string text = text_of(line.pass(time));
    int count = 0;
    for (std::size_t at = 0; (at = text.find(packet, at)) != std::string::npos; ++at) ++count;
    return count;
  };
  CHECK(packets_in(1s) == 0);
  line.say("FA FB 06 25 3B 01 00 26 3B");
  CHECK(packets_in(1s) == 1);
  line.say("FA FB 06 25 3B 02 00 27 3B");
  CHECK(packets_in(1s) >= 8);  // ten information packets a second
  line.say("FA FB 06 25 3B 00 00 25 3B");
  (void)packets_in(100ms);  // what is still on the line
  CHECK(packets_in(1s) == 0);
}

TEST_CASE("a gripper's packet says that there is none, and the next host must ask anew",
          "[emulators][p2os][gripper]") {
  OpenPioneer line;
  line.say("FA FB 06 25 3B 02 00 27 3B");
  CHECK_THAT(text_of(line.pass(400ms)), Catch::Contains("FA FB 06 E0 00 00 00 E0 00"));
  line.say(kSync2);  // CLOSE
  (void)line.pass(400ms);
  line.open();
  CHECK_THAT(text_of(line.pass(400ms)), !Catch::Contains("FA FB 06 E0"));
}
