// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "hex_bytes.hpp"
#include "orca/hw/p2os/command.hpp"
#include "orca/hw/p2os/gripper.hpp"

using namespace orca::hw;
using p2os::GripperAction;
using p2os::GripperState;

namespace {

constexpr std::uint8_t kNoContact = 0x30;  // inputs of paddles on which nothing presses

GripperState state_of(std::uint8_t state, std::uint8_t inputs = kNoContact) {
  p2os::PortState ports;
  ports.gripper = state;
  ports.digital_in = inputs;
  return p2os::gripper_of(ports);
}

}  // namespace

TEST_CASE("a command to the gripper is number 33 with an integer", "[hw][p2os][gripper]") {
  // Sums of 21 3B and 01 00, 02 00, 0F 00.
  CHECK(test::text_of(p2os::encode_gripper(GripperAction::open).view()) == "FA FB 06 21 3B 01 00 22 3B");
  CHECK(test::text_of(p2os::encode_gripper(GripperAction::close).view()) == "FA FB 06 21 3B 02 00 23 3B");
  CHECK(test::text_of(p2os::encode_gripper(GripperAction::halt).view()) == "FA FB 06 21 3B 0F 00 30 3B");
}

TEST_CASE("what a robot receives as a command to its gripper is what was sent", "[hw][p2os][gripper]") {
  for (const GripperAction action :
       {GripperAction::open, GripperAction::close, GripperAction::stop, GripperAction::lift_up,
        GripperAction::lift_down, GripperAction::lift_stop, GripperAction::store, GripperAction::deploy,
        GripperAction::halt, GripperAction::press, GripperAction::lift_carry}) {
    const p2os::Packet packet = p2os::encode_gripper(action);
    const auto received = p2os::decode_command(p2os::body_of(packet.view()));
    REQUIRE(received);
    CHECK(received->number == 33);
    CHECK(received->value == static_cast<int>(action));
  }
}

TEST_CASE("each bit of a gripper's state is one thing", "[hw][p2os][gripper]") {
  CHECK(state_of(0x00) == GripperState{});
  CHECK(state_of(0x01) == GripperState{.open = true});
  CHECK(state_of(0x02) == GripperState{.closed = true});
  CHECK(state_of(0x04) == GripperState{.paddles_move = true});
  CHECK(state_of(0x08) == GripperState{});
  CHECK(state_of(0x10) == GripperState{.up = true});
  CHECK(state_of(0x20) == GripperState{.down = true});
  CHECK(state_of(0x40) == GripperState{.lift_moves = true});
}

TEST_CASE("beams that are interrupted raise their inputs, contacts lower theirs", "[hw][p2os][gripper]") {
  CHECK(state_of(0, 0x38) == GripperState{.inner_beam = true});
  CHECK(state_of(0, 0x34) == GripperState{.outer_beam = true});
  CHECK(state_of(0, 0x20) == GripperState{.left_contact = true});
  CHECK(state_of(0, 0x10) == GripperState{.right_contact = true});
  CHECK(state_of(0, 0xF3) == GripperState{});
}
