// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/player/session.hpp"

#include <catch2/catch.hpp>

#include "player_bytes.hpp"

using namespace orca::hw::player;
using namespace orca::hw::player::test;

TEST_CASE("the list of devices has its count twice", "[hw][player]") {
  const DeviceList list{{captured(Interface::position2d), captured(Interface::sonar),
                         captured(Interface::bumper), captured(Interface::power),
                         captured(Interface::laser)}};
  const Bytes bytes = words(
      "00000005 00000005 | 0100007F 00004119 00000004 00000000 | 0100007F 00004119 00000005 00000000"
      "| 0100007F 00004119 0000000E 00000000 | 0100007F 00004119 00000002 00000000"
      "| 0100007F 00004119 00000006 00000000");
  CHECK(bytes.size() == 88);
  CHECK(agree(list, bytes));
  CHECK(agree(DeviceList{}, words("00000000 00000000")));
}

TEST_CASE("a device of an interface that Orca does not know stays in the list", "[hw][player]") {
  CHECK(agree(DeviceList{{Address{1, 2, static_cast<Interface>(49), 3}}},
              words("00000001 00000001 | 00000001 00000002 00000031 00000003")));
}

TEST_CASE("the wish to open a device has no driver name", "[hw][player]") {
  CHECK(agree(Subscription{.device = {.interface = Interface::position2d}, .access = Access::open},
              words("00000000 00000000 00000004 00000000 00000001 00000000 00000000")));
}

TEST_CASE("the answer names the driver with its zero byte, filled up to a multiple of four", "[hw][player]") {
  CHECK(agree(Subscription{captured(Interface::position2d), Access::open, "p2os"},
              words("0100007F 00004119 00000004 00000000 00000001 00000005 00000005 70326F73 00000000")));
  CHECK(agree(
      Subscription{captured(Interface::laser), Access::open, "sicklms200"},
      words("0100007F 00004119 00000006 00000000 00000001 0000000B 0000000B 7369636B 6C6D7332 30300000")));
}

TEST_CASE("a driver that does not start is an answer with access 3", "[hw][player]") {
  CHECK(agree(Subscription{captured(Interface::laser), Access::refused, "abc"},
              words("0100007F 00004119 00000006 00000000 00000003 00000004 00000004 61626300")));
}

TEST_CASE("a question for a driver has no name, its answer has one", "[hw][player]") {
  const Address device{.interface = Interface::position2d};
  const Bytes question = words("00000000 00000000 00000004 00000000 00000000 00000000");
  CHECK(question.size() == 24);
  CHECK(agree(DriverInfo{.device = device}, question));
  CHECK(agree(DriverInfo{device, "p2os"},
              words("00000000 00000000 00000004 00000000 00000005 00000005 70326F73 00000000")));
}

TEST_CASE("a name that its sender did not end with a zero byte is read", "[hw][player]") {
  const auto info =
      decode<DriverInfo>(words("00000000 00000000 00000004 00000000 00000004 00000004 70326F73"));
  CHECK(info.value().driver == "p2os");
}

TEST_CASE("a name ends at its first zero byte", "[hw][player]") {
  CHECK(encode(DriverInfo{{}, std::string("ab\0cd", 5)}) ==
        words("00000000 00000000 00000001 00000000 00000003 00000003 61620000"));
}

TEST_CASE("push and pull are modes 1 and 2", "[hw][player]") {
  CHECK(agree(DataMode{DataMode::Mode::push}, words("00000001")));
  CHECK(agree(DataMode{DataMode::Mode::pull}, words("00000002")));
}

TEST_CASE("a capability query names a type and a subtype", "[hw][player]") {
  CHECK(agree(Capability{3, 1}, words("00000003 00000001")));
}

TEST_CASE("a synch ends a round of data", "[hw][player]") {
  CHECK(make_message(header_for(kSynch)).value() ==
        words("00000000 00000000 00000001 00000000 00000005 00000001 0000000000000000 00000000 00000000"));
}
