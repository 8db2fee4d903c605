// SPDX-License-Identifier: GPL-3.0-or-later
// The packets and bits are written out by hand from the gripper's manual.
#include <catch2/catch.hpp>

#include "hex_bytes.hpp"
#include "orca/hw/p2os/command.hpp"
#include "orca/hw/p2os/gripper.hpp"

using namespace orca::hw;
using p2os::GripperAction;
using p2os::GripperState;
using p2os::PortState;

namespace {

struct Spelled {
  GripperAction action;
  const char* packet;
};

// The checksum adds 21 3B and the argument, whose low byte is the high one of its word: 1 gives 213B + 0100 = 223B.
constexpr Spelled kActions[] = {{GripperAction::open, "FA FB 06 21 3B 01 00 22 3B"},
                                {GripperAction::close, "FA FB 06 21 3B 02 00 23 3B"},
                                {GripperAction::stop, "FA FB 06 21 3B 03 00 24 3B"},
                                {GripperAction::up, "FA FB 06 21 3B 04 00 25 3B"},
                                {GripperAction::down, "FA FB 06 21 3B 05 00 26 3B"},
                                {GripperAction::stop_lift, "FA FB 06 21 3B 06 00 27 3B"},
                                {GripperAction::store, "FA FB 06 21 3B 07 00 28 3B"},
                                {GripperAction::deploy, "FA FB 06 21 3B 08 00 29 3B"},
                                {GripperAction::halt, "FA FB 06 21 3B 0F 00 30 3B"},
                                {GripperAction::pressure, "FA FB 06 21 3B 10 00 31 3B"},
                                {GripperAction::carry, "FA FB 06 21 3B 11 00 32 3B"}};

// Inputs of a gripper that nothing touches: both switches of the paddles are 1.
constexpr std::uint8_t kUntouched = 0x30;

GripperState state(std::uint8_t gripper, std::uint8_t digital_in) {
  return p2os::gripper_of(PortState{.digital_in = digital_in, .gripper = gripper});
}

}  // namespace

TEST_CASE("what a gripper is to do is command 33 with its number", "[hw][p2os]") {
  for (const Spelled& spelled : kActions)
    CHECK(test::text_of(p2os::encode_gripper(spelled.action).view()) == spelled.packet);
}

TEST_CASE("the argument of a gripper's command is command 36", "[hw][p2os]") {
  CHECK(test::text_of(encode(p2os::Command::gripperval, 50).view()) == "FA FB 06 24 3B 32 00 56 3B");
  CHECK(test::text_of(encode(p2os::Command::gripperval, -50).view()) == "FA FB 06 24 1B 32 00 56 1B");
}

TEST_CASE("a gripper's command is read as it was written", "[hw][p2os]") {
  for (const Spelled& spelled : kActions) {
    const p2os::Packet packet = p2os::encode_gripper(spelled.action);
    const auto command = p2os::decode_command(p2os::body_of(packet.view())).value();
    CHECK(command.number == static_cast<int>(p2os::Command::gripper));
    CHECK(command.argument == p2os::ReceivedCommand::Argument::integer);
    CHECK(command.value == static_cast<int>(spelled.action));
  }
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
