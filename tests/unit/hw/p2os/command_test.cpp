// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <limits>
#include <numbers>
#include <string>

#include "hex_bytes.hpp"
#include "orca/hw/p2os/command.hpp"
#include "orca/hw/p2os/gripper.hpp"

using namespace orca::hw;
using p2os::Command;
using p2os::GripperAction;
using p2os::GripperState;
using p2os::PortState;

namespace {

std::string sent(const p2os::Packet& packet) { return test::text_of(packet.view()); }

constexpr double kDegrees = std::numbers::pi / 180.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Spelled {
  GripperAction action;
  const char* packet;
};

// The checksum adds 21 3B and the argument, whose low byte is the high one of its word: 1 gives 213B + 0100 = 223B.
constexpr Spelled kActions[] = {{GripperAction::open, "FA FB 06 21 3B 01 00 22 3B"},
                                {GripperAction::close, "FA FB 06 21 3B 02 00 23 3B"},
                                {GripperAction::up, "FA FB 06 21 3B 04 00 25 3B"},
                                {GripperAction::down, "FA FB 06 21 3B 05 00 26 3B"},
                                {GripperAction::halt, "FA FB 06 21 3B 0F 00 30 3B"}};

// Inputs of a gripper that nothing touches: both switches of the paddles are 1.
constexpr std::uint8_t kUntouched = 0x30;

GripperState state(std::uint8_t gripper, std::uint8_t digital_in) {
  return p2os::gripper_of(PortState{.digital_in = digital_in, .gripper = gripper});
}

}  // namespace

TEST_CASE("the handshake is three packets of a number", "[hw][p2os]") {
  CHECK(sent(p2os::sync(0)) == "FA FB 03 00 00 00");
  CHECK(sent(p2os::sync(1)) == "FA FB 03 01 00 01");
  CHECK(sent(p2os::sync(2)) == "FA FB 03 02 00 02");
}

TEST_CASE("commands without an argument are a number", "[hw][p2os]") {
  CHECK(sent(encode(Command::pulse)) == "FA FB 03 00 00 00");
  CHECK(sent(encode(Command::open)) == "FA FB 03 01 00 01");
  CHECK(sent(encode(Command::close)) == "FA FB 03 02 00 02");
  CHECK(sent(encode(Command::stop)) == "FA FB 03 1D 00 1D");
  CHECK(sent(encode(Command::estop)) == "FA FB 03 37 00 37");
}

TEST_CASE("integers are sent as a type for the sign and a magnitude", "[hw][p2os]") {
  CHECK(sent(encode(Command::open, 1)) == "FA FB 06 01 3B 01 00 02 3B");
  CHECK(sent(encode(Command::enable, 1)) == "FA FB 06 04 3B 01 00 05 3B");
  CHECK(sent(encode(Command::enable, 0)) == "FA FB 06 04 3B 00 00 04 3B");
  CHECK(sent(encode(Command::vel, 200)) == "FA FB 06 0B 3B C8 00 D3 3B");
  CHECK(sent(encode(Command::vel, -200)) == "FA FB 06 0B 1B C8 00 D3 1B");
  CHECK(sent(encode(Command::rvel, 30)) == "FA FB 06 15 3B 1E 00 33 3B");
  CHECK(sent(encode(Command::rvel, -30)) == "FA FB 06 15 1B 1E 00 33 1B");
  CHECK(sent(encode(Command::sonar, 1)) == "FA FB 06 1C 3B 01 00 1D 3B");
  CHECK(sent(encode(Command::sonar, 0)) == "FA FB 06 1C 3B 00 00 1C 3B");
  CHECK(sent(encode(Command::config, 1)) == "FA FB 06 12 3B 01 00 13 3B");
  CHECK(sent(encode(Command::hostbaud, 2)) == "FA FB 06 32 3B 02 00 34 3B");
}

TEST_CASE("integers beyond 16 bits are limited and never wrap to the other sign", "[hw][p2os]") {
  CHECK(sent(encode(Command::vel, -40000)) == sent(encode(Command::vel, -32768)));
  CHECK(sent(encode(Command::vel, 70000)) == sent(encode(Command::vel, 65535)));
  CHECK(test::text_of(p2os::body_of(encode(Command::vel, 65535).view())) == "0B 3B FF FF");
}

TEST_CASE("speeds and turn rates are sent in mm/s and deg/s", "[hw][p2os]") {
  CHECK(sent(p2os::encode_speed(0.2)) == "FA FB 06 0B 3B C8 00 D3 3B");
  CHECK(sent(p2os::encode_speed(-0.1999)) == "FA FB 06 0B 1B C8 00 D3 1B");
  CHECK(sent(p2os::encode_turn_rate(30.4 * kDegrees)) == "FA FB 06 15 3B 1E 00 33 3B");
  CHECK(sent(p2os::encode_turn_rate(-30 * kDegrees)) == "FA FB 06 15 1B 1E 00 33 1B");
}

TEST_CASE("a speed that is no number stops the robot, and one beyond 16 bits keeps its sign", "[hw][p2os]") {
  CHECK(sent(p2os::encode_speed(kNan)) == sent(encode(Command::vel, 0)));
  CHECK(sent(p2os::encode_turn_rate(-std::numeric_limits<double>::infinity())) ==
        sent(encode(Command::rvel, 0)));
  CHECK(sent(p2os::encode_speed(1e9)) == sent(encode(Command::vel, 32767)));
  CHECK(sent(p2os::encode_speed(-1e9)) == sent(encode(Command::vel, -32767)));
}

// The packets and bits are written out by hand from the gripper's manual.

TEST_CASE("what a gripper is to do is command 33 with its number", "[hw][p2os]") {
  for (const Spelled& spelled : kActions)
    CHECK(test::text_of(p2os::encode_gripper(spelled.action).view()) == spelled.packet);
}

TEST_CASE("each bit of a gripper's state byte has its own meaning, and two tell of faults", "[hw][p2os]") {
  CHECK(state(0x00, kUntouched) == GripperState{});
  CHECK(state(0x01, kUntouched) == GripperState{.open = true});
  CHECK(state(0x02, kUntouched) == GripperState{.closed = true});
  CHECK(state(0x04, kUntouched) == GripperState{.paddles_move = true});
  CHECK(state(0x08, kUntouched) == GripperState{});
  CHECK(state(0x10, kUntouched) == GripperState{.up = true});
  CHECK(state(0x20, kUntouched) == GripperState{.down = true});
  CHECK(state(0x40, kUntouched) == GripperState{.lift_moves = true});
  CHECK(state(0x80, kUntouched) == GripperState{});
}

TEST_CASE("beams that are interrupted are 1 at a gripper's inputs, paddles that are pressed are 0",
          "[hw][p2os]") {
  CHECK(state(0, 0x34) == GripperState{.outer_beam = true});
  CHECK(state(0, 0x38) == GripperState{.inner_beam = true});
  CHECK(state(0, 0x20) == GripperState{.left_contact = true});
  CHECK(state(0, 0x10) == GripperState{.right_contact = true});
}

TEST_CASE("the switches at the ends of paddles and lift, and lines that are no gripper's, change nothing",
          "[hw][p2os]") {
  for (const int line : {0x01, 0x02, 0x40, 0x80})
    CHECK(state(0, static_cast<std::uint8_t>(kUntouched | line)) == GripperState{});
}

TEST_CASE("the state of a gripper is read from the ports of a SIP", "[hw][p2os]") {
  // Closed, lift down; the inner beam is interrupted, and both paddles are pressed.
  const auto body = test::hex(
      "32 00 00 00 00 00 00 00 00 00 00 7F 00 00 00 00 01 00 00 00 "  // no sonar
      "00 22 00 09 00");
  const auto sip = p2os::parse_sip(body, p2os::choose_model("p2dx").model).value();
  const GripperState expected{
      .closed = true, .down = true, .inner_beam = true, .left_contact = true, .right_contact = true};
  CHECK(p2os::gripper_of(sip.ports.value()) == expected);
}
