// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes are those of the protocol's description, written out by hand.
#include <catch2/catch.hpp>

#include "pioneer_line.hpp"

using namespace orca;
using namespace orca::emulators;
using namespace orca::emulators::test;
using namespace std::chrono_literals;
using Moves = std::vector<GripperMove>;

namespace {

/// A Pioneer with a gripper, and its host, which has opened the connection.
struct GripperLine : PioneerLine {
  GripperLine() {
    body.look.emplace();
    open();
  }
  Moves told(const std::string& bytes) {
    body.moves.clear();
    say(bytes);
    return body.moves;
  }
  /// The gripper's state and the digital inputs of the next information packet, in which no sonar is told.
  std::string shown() {
    const hw::test::Bytes packet = information();
    return hw::test::text_of(std::vector<std::uint8_t>{packet[24], packet[26]});
  }
};

const Moves kHalt{GripperMove::stop, GripperMove::stop_lift};

}  // namespace

TEST_CASE("the emulated Pioneer moves its gripper as it is told", "[emulators][p2os][gripper]") {
  GripperLine line;
  CHECK(line.told("FA FB 06 21 3B 01 00 22 3B") == Moves{GripperMove::open});
  CHECK(line.told("FA FB 06 21 3B 02 00 23 3B") == Moves{GripperMove::close});
  CHECK(line.told("FA FB 06 21 3B 03 00 24 3B") == Moves{GripperMove::stop});
  CHECK(line.told("FA FB 06 21 3B 04 00 25 3B") == Moves{GripperMove::up});
  CHECK(line.told("FA FB 06 21 3B 05 00 26 3B") == Moves{GripperMove::down});
  CHECK(line.told("FA FB 06 21 3B 06 00 27 3B") == Moves{GripperMove::stop_lift});
  CHECK(line.told("FA FB 06 21 3B 07 00 28 3B") == Moves{GripperMove::close, GripperMove::up});
  CHECK(line.told("FA FB 06 21 3B 08 00 29 3B") == Moves{GripperMove::open, GripperMove::down});
  CHECK(line.told("FA FB 06 21 3B 0F 00 30 3B") == kHalt);
}

TEST_CASE("commands to a gripper that are not known move nothing, nor do those without a number",
          "[emulators][p2os][gripper]") {
  GripperLine line;
  CHECK(line.told("FA FB 06 21 3B 09 00 2A 3B").empty());
  CHECK(line.told("FA FB 03 21 00 21").empty());
}

TEST_CASE("the gripper halts when the host goes, is silent, or the red button is pressed",
          "[emulators][p2os][gripper]") {
  GripperLine line;
  CHECK(line.told("FA FB 03 02 00 02") == kHalt);  // CLOSE
  line.open();
  line.body.moves.clear();
  (void)line.pass(1900ms);
  CHECK(line.body.moves.empty());
  (void)line.pass(200ms);
  CHECK(line.body.moves == kHalt);
  line.body.moves.clear();
  line.firmware.press_button(true);
  CHECK(line.body.moves == kHalt);
}

TEST_CASE("an information packet shows the gripper, whose inputs are low where ends and contacts are made",
          "[emulators][p2os][gripper]") {
  GripperLine line;
  CHECK(line.shown() == "00 33");  // nothing is made, no beam is interrupted
  line.body.look = GripperLook{.open = true, .down = true, .outer_beam = true};
  CHECK(line.shown() == "21 34");
  line.body.look = GripperLook{.closed = true, .up = true, .left_contact = true, .right_contact = true};
  CHECK(line.shown() == "12 01");
  line.body.look = GripperLook{.paddles_move = true, .lift_moves = true, .inner_beam = true};
  CHECK(line.shown() == "44 3B");
}

TEST_CASE("a Pioneer without a gripper shows none", "[emulators][p2os][gripper]") {
  GripperLine line;
  line.body.look.reset();
  CHECK(line.shown() == "00 00");
}
