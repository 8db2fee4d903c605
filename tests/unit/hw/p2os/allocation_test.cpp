// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "allocation_counter.hpp"
#include "hex_bytes.hpp"
#include "orca/hw/p2os/command.hpp"
#include "orca/hw/p2os/gripper.hpp"
#include "orca/hw/p2os/sip.hpp"

using namespace orca::hw;

TEST_CASE("what a Pioneer's driver does in each cycle takes no memory", "[hw][p2os]") {
  const auto body = test::hex(
      "33 A6 04 89 7F 00 04 BE 00 D2 00 7E 00 00 00 04 01 00 2D 04 00 93 0E 01 93 0E 02 52 17 03 E1 48");
  const p2os::Model& model = p2os::choose_model("p2dx").model;
  const long before = orca::test::allocations();
  const auto sip = p2os::parse_sip(body, model);
  const p2os::Packet speed = p2os::encode_speed(0.2);
  const p2os::Packet grip = p2os::encode_gripper(p2os::GripperAction::close);
  const p2os::GripperState gripper = p2os::gripper_of({.gripper = 1});
  CHECK(orca::test::allocations() == before);
  CHECK(sip->echoes.size() == 4);
  CHECK(speed.size() + grip.size() == 18);
  CHECK(gripper.open);
}
