// SPDX-License-Identifier: GPL-3.0-or-later
// An emulated Player server with several clients at the same time.
#include <catch2/catch.hpp>

#include <string>

#include "player_desk.hpp"

using namespace orca;
using namespace orca::test;

TEST_CASE("clients of one Player server have their own subscriptions and ways to get data", "[emulators]") {
  ConnectedDesk desk;
  const auto other = desk.other_client();
  (void)desk.open("00000004");
  (void)desk.open_at(*other, "00000005");
  (void)desk.say_to(*other, "00000001 00000000 00000003 00000005", "00000002");
  desk.now += 100ms;
  CHECK(Parts(desk.server.advance(desk.now)).head == "0100007F 00001A09 00000004 00000000 00000001 00000001");
  CHECK(other->advance(desk.now).empty());  // it pulls
  CHECK(desk.say_to(*other, "00000001 00000000 00000003 00000004").size() == 40 + 56 + 40);
  CHECK(desk.say_to(*other, kMotorsOn, "00000001").empty());  // it has not opened the base
}

TEST_CASE("each client of a Player server gets each scan once", "[emulators]") {
  ConnectedDesk desk;
  const auto other = desk.other_client();
  (void)desk.open("00000006");
  (void)desk.open_at(*other, "00000006");
  for (int number = 0; number < 3; ++number) {
    desk.mirror.stamp = TimePoint(1s + 13ms * number);
    desk.now += 100ms;
    const Bytes scan = desk.server.advance(desk.now);
    CHECK(Parts(scan).payload.ends_with("00000000 0000000" + std::to_string(number)));
    CHECK(Parts(other->advance(desk.now)).payload == Parts(scan).payload);
    CHECK(other->advance(desk.now + 50ms).empty());
  }
}

TEST_CASE("of several clients of a Player server the last command counts, until the last one closes the base",
          "[emulators]") {
  ConnectedDesk desk;
  const auto other = desk.other_client();
  (void)desk.open("00000004");
  (void)desk.open_at(*other, "00000004");
  (void)desk.say(kMotorsOn, "00000001");
  (void)desk.say(kVelocity, kAheadLeft);
  (void)desk.say_to(*other, kVelocity, "3FB999999999999A 0000000000000000 0000000000000000 00000001");
  CHECK(desk.body.told == Twist2{0.1, 0.0, 0.0});
  other->note_host(false, desk.now);  // a server does not ask who has commanded what
  CHECK(desk.body.told == Twist2{0.1, 0.0, 0.0});
  CHECK(desk.server.has_power());
  desk.server.note_host(false, desk.now);
  CHECK(desk.body.told == Twist2{});
  CHECK_FALSE(desk.server.has_power());
}

TEST_CASE("a client of a Player server that opens or closes a device twice counts once", "[emulators]") {
  ConnectedDesk desk;
  const auto other = desk.other_client();
  (void)desk.open("00000004");
  (void)desk.open("00000004");
  (void)desk.open_at(*other, "00000004");
  (void)desk.say(kMotorsOn, "00000001");
  (void)desk.say(kVelocity, kAheadLeft);
  for (int i = 0; i < 2; ++i)
    (void)desk.say("00000001 00000000 00000003 00000003",
                   "00000000 00000000 00000004 00000000 00000002 00000000 00000000");
  CHECK(desk.body.told == Twist2{0.2, 0.0, 0.1});
  other->note_host(false, desk.now);
  CHECK(desk.body.told == Twist2{});
}
