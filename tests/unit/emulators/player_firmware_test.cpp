// SPDX-License-Identifier: GPL-3.0-or-later
// An emulated Player server and one client.
#include <catch2/catch.hpp>

#include <span>
#include <string>

#include "player_desk.hpp"

using namespace orca;
using namespace orca::test;

TEST_CASE("a Player server greets each client with its banner, a moment after it has come", "[emulators]") {
  PlayerDesk desk;
  CHECK(desk.pass(1s).empty());
  desk.server.note_host(true, desk.now);
  CHECK(desk.pass(10ms).empty());
  CHECK(in_words(desk.pass(40ms)) == kBanner);
  desk.server.note_host(true, desk.now);  // still there
  CHECK(desk.pass(1s).empty());
  desk.server.note_host(false, desk.now);
  CHECK(desk.pass(1s).empty());
  CHECK(desk.connect() == kBanner);
  CHECK(desk.server.connections() == 2);
}

TEST_CASE("a Player server that hears from a client of which the line said nothing greets it first",
          "[emulators]") {
  PlayerDesk desk;
  const Bytes said = desk.say("00000001 00000000 00000003 00000005", "00000001");
  REQUIRE(said.size() == 32 + 40);
  CHECK(in_words(std::span(said).first(32)) == kBanner);
}

TEST_CASE("a Player server lists its devices, and repeats the address, subtype and sequence of a request",
          "[emulators]") {
  ConnectedDesk desk;
  const Parts list(desk.say("00000001 00000000 00000003 00000001"));
  CHECK(list.head == "0100007F 00001A09 00000001 00000000 00000004 00000001");
  CHECK(list.tail == "0000002A 00000058");
  CHECK(list.payload ==
        "00000005 00000005 "
        "0100007F 00001A09 00000004 00000000 0100007F 00001A09 00000005 00000000 "
        "0100007F 00001A09 0000000E 00000000 0100007F 00001A09 00000002 00000000 "
        "0100007F 00001A09 00000006 00000000");
}

TEST_CASE("a Player server names the drivers of its devices", "[emulators]") {
  ConnectedDesk desk;
  const std::string ask = "00000001 00000000 00000003 00000002";
  CHECK(Parts(desk.say(ask, "00000000 00000000 00000006 00000000 00000000 00000000")).payload ==
        "0100007F 00001A09 00000006 00000000 0000000B 0000000B 7369636B 6C6D7332 30300000");
  const Parts unknown(desk.say(ask, "00000000 00000000 0000003E 00000000 00000000 00000000"));
  CHECK(unknown.head == "0100007F 00001A09 00000001 00000000 00000006 00000002");  // NACK
  CHECK(unknown.payload.empty());
}

TEST_CASE("a Player server opens devices, refuses those that do not start, and knows no others",
          "[emulators]") {
  PlayerSettings settings = with_two_sonars();
  settings.refused = {5};
  settings.missing = {14};
  ConnectedDesk desk(settings);
  CHECK(desk.open("00000004") ==
        "0100007F 00001A09 00000004 00000000 00000001 00000005 00000005 70326F73 00000000");
  CHECK(desk.server.is_subscribed(4));
  CHECK(desk.open("00000005") ==
        "0100007F 00001A09 00000005 00000000 00000003 00000005 00000005 70326F73 00000000");
  CHECK_FALSE(desk.server.is_subscribed(5));
  const Parts missing(desk.say("00000001 00000000 00000003 00000003",
                               "00000000 00000000 0000000E 00000000 00000001 00000000 00000000"));
  CHECK(missing.head == "0100007F 00001A09 00000001 00000000 00000006 00000003");
  const Parts closed(desk.say("00000001 00000000 00000003 00000003",
                              "00000000 00000000 00000004 00000000 00000002 00000000 00000000"));
  CHECK(closed.payload == "0100007F 00001A09 00000004 00000000 00000002 00000005 00000005 70326F73 00000000");
  CHECK_FALSE(desk.server.is_subscribed(4));
}

TEST_CASE("an emulated Player base turns its wheels when its motors have power, and says where it is",
          "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("00000004");
  CHECK(desk.say(kVelocity, kAheadLeft).empty());
  CHECK(desk.body.told == Twist2{});
  const Parts on(desk.say(kMotorsOn, "00000001"));
  CHECK(on.head == "0100007F 00001A09 00000004 00000000 00000004 00000002");
  CHECK(on.tail == "0000002A 00000000");
  CHECK(desk.server.has_power());
  CHECK(desk.body.told == Twist2{0.2, 0.0, 0.1});
  desk.body.pose = {1.0, 2.0, 0.5};
  const Parts state(desk.pass(100ms));
  CHECK(state.head == "0100007F 00001A09 00000004 00000000 00000001 00000001");
  CHECK(state.payload ==
        "3FF00000 00000000 40000000 00000000 3FE00000 00000000 3FC99999 9999999A 00000000 00000000 3FB99999 "
        "9999999A 00000000");
  CHECK(desk.pass(99ms).empty());
  desk.body.stalled = true;
  CHECK(Parts(desk.pass(1ms)).payload.ends_with("9999999A 00000001"));
  (void)desk.say(kVelocity, "3FC999999999999A 0000000000000000 3FB999999999999A 00000000");
  CHECK(desk.body.told == Twist2{});  // the command itself lets them rest
}

TEST_CASE("an emulated Player base drives on without commands, until its client has gone", "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("00000004");
  (void)desk.say(kMotorsOn, "00000001");
  (void)desk.say(kVelocity, kAheadLeft);
  (void)desk.pass(60s);
  CHECK(desk.body.told == Twist2{0.2, 0.0, 0.1});
  desk.server.note_host(false, desk.now);
  CHECK(desk.body.told == Twist2{});
  CHECK_FALSE(desk.server.has_power());
  CHECK_FALSE(desk.server.is_subscribed(4));
}

TEST_CASE("an emulated Player base takes the pose that it is told, and tells its size", "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("00000004");
  const Parts set(
      desk.say("00000004 00000000 00000003 00000005", "3FF0000000000000 4000000000000000 0000000000000000"));
  CHECK(set.head == "0100007F 00001A09 00000004 00000000 00000004 00000005");
  CHECK(Parts(desk.pass(100ms)).payload.starts_with("3FF00000 00000000 40000000 00000000 00000000 00000000"));
  (void)desk.say("00000004 00000000 00000003 00000006");
  CHECK(Parts(desk.pass(100ms)).payload.starts_with("00000000 00000000 00000000 00000000 00000000 00000000"));
  const Parts size(desk.say("00000004 00000000 00000003 00000001"));
  CHECK(size.tail == "0000002A 00000048");
  CHECK(size.payload.ends_with("3FD851EB 851EB852 3FDC28F5 C28F5C29 00000000 00000000"));  // 0.38 m, 0.44 m
}

TEST_CASE("emulated Player sonars tell ranges and places", "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("00000005");
  const Parts ranges(desk.pass(100ms));
  CHECK(ranges.head == "0100007F 00001A09 00000005 00000000 00000001 00000001");
  CHECK(ranges.payload == "00000002 00000002 40A00000 3F000000");  // no echo: 5 m; 0.5 m
  const Parts places(desk.say("00000005 00000000 00000003 00000001"));
  CHECK(places.tail == "0000002A 00000068");
  CHECK(places.payload.starts_with("00000002 00000002 00000000 00000000 3FE00000 00000000"));
  CHECK(places.payload.ends_with("BFF00000 00000000"));
  CHECK(Parts(desk.say("00000005 00000000 00000003 00000002", "00000001")).payload.empty());
}

TEST_CASE("an emulated Player laser sends each scan once, and what comes back from nowhere has its range",
          "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("00000006");
  CHECK(desk.pass(100ms).empty());  // its mirror does not turn yet
  desk.mirror.stamp = TimePoint(1s);
  const Parts scan(desk.pass(100ms));
  CHECK(scan.head == "0100007F 00001A09 00000006 00000000 00000001 00000001");
  CHECK(scan.payload ==
        "BF000000 3F000000 3F000000 41000000 00000003 00000003 3F800000 40000000 41000000 00000003 00000003 "
        "00000000 00000000");
  CHECK(desk.pass(100ms).empty());
  desk.mirror.stamp = TimePoint(1013ms);
  CHECK(Parts(desk.pass(100ms)).payload.ends_with("00000000 00000001"));  // its number
  CHECK(Parts(desk.say("00000006 00000000 00000003 00000003"))
            .payload.starts_with("BF000000 3F000000 3F000000 41000000"));
  CHECK(Parts(desk.say("00000006 00000000 00000003 00000001")).tail == "0000002A 00000048");
}

TEST_CASE("an emulated server like Stage shows sonars and laser as rangers, of 8 bytes a range",
          "[emulators]") {
  PlayerSettings settings = with_two_sonars();
  settings.shows_rangers = true;
  ConnectedDesk desk(settings);
  const Parts list(desk.say("00000001 00000000 00000003 00000001"));
  CHECK(list.payload ==
        "00000005 00000005 "
        "0100007F 00001A09 00000004 00000000 0100007F 00001A09 0000003E 00000000 "
        "0100007F 00001A09 0000000E 00000000 0100007F 00001A09 00000002 00000000 "
        "0100007F 00001A09 0000003E 00000001");
  CHECK(Parts(desk.open_at(desk.server, "00000005")).head ==
        "0100007F 00001A09 00000001 00000000 00000006 00000003");  // there is no sonar:0

  SECTION("sonars are the elements of ranger:0") {
    CHECK(desk.open("0000003E").starts_with("0100007F 00001A09 0000003E 00000000 00000001"));
    const Parts ranges(desk.pass(100ms));
    CHECK(ranges.head == "0100007F 00001A09 0000003E 00000000 00000001 00000001");
    CHECK(ranges.payload == "00000002 00000002 40140000 00000000 3FE00000 00000000");  // 5 m, 0.5 m
    const Parts places(desk.say("0000003E 00000000 00000003 00000001"));
    CHECK(places.tail == "0000002A 000000E8");
    // Each at 0.24 m: the height is that of the device.
    CHECK(places.payload.substr(0, 53) == "00000000 00000000 00000000 00000000 3FCEB851 EB851EB8");
    CHECK(
        places.payload.substr(18 * 9, 107) ==
        "00000002 00000002 00000000 00000000 3FE00000 00000000 00000000 00000000 00000000 00000000 00000000 "
        "00000000");
    CHECK(Parts(desk.say("0000003E 00000000 00000003 00000005")).tail == "0000002A 00000038");
  }
  SECTION("the laser is ranger:1") {
    (void)desk.say("00000001 00000000 00000003 00000003",
                   "00000000 00000000 0000003E 00000001 00000001 00000000 00000000");
    desk.mirror.stamp = TimePoint(1s);
    const Parts scan(desk.pass(100ms));
    CHECK(scan.head == "0100007F 00001A09 0000003E 00000001 00000001 00000001");
    CHECK(scan.payload ==
          "00000003 00000003 3FF00000 00000000 40000000 00000000 40200000 00000000");  // 1, 2, 8 m
    const Parts config(desk.say("0000003E 00000001 00000003 00000005"));
    // From -0.5 rad to 0.5 rad. Stage's resolution is this over the number of beams: 0.333 rad.
    CHECK(config.payload.starts_with("BFE00000 00000000 3FE00000 00000000 3FD55555 55555555"));
    const Parts place(desk.say("0000003E 00000001 00000003 00000001"));
    CHECK(place.payload.starts_with(
        "3F916872 B020C49C 3F80624D D2F1A9FC 3FD33333 33333333"));  // 17, 8 mm, 0.3 m
  }
}

TEST_CASE("emulated Player bumpers lie in front first, and a battery tells its voltage", "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("0000000E");
  desk.body.pressed = 0x0201;  // the first in front, the second behind
  CHECK(Parts(desk.pass(100ms)).payload == "0000000A 0000000A 01000000 00000100 00000000");
  ConnectedDesk other;
  (void)other.open("00000002");
  CHECK(Parts(other.pass(100ms)).payload == "00000001 414B3333 00000000 00000000 00000000 00000000");
}

TEST_CASE("in pull mode the newest data wait until they are asked for, and a synch ends them",
          "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("00000005");
  CHECK(Parts(desk.say("00000001 00000000 00000003 00000005", "00000002")).head ==
        "0100007F 00001A09 00000001 00000000 00000004 00000005");
  CHECK(desk.pass(350ms).empty());
  const std::string ask = "00000001 00000000 00000003 00000004";
  const Bytes round = desk.say(ask);
  REQUIRE(round.size() == 40 + 56 + 40);
  CHECK(in_words(std::span(round).subspan(16, 8)) == "00000004 00000004");
  CHECK(in_words(std::span(round).subspan(40 + 16, 8)) == "00000001 00000001");
  CHECK(in_words(std::span(round).subspan(96 + 8, 16)) == "00000001 00000000 00000005 00000001");
}

// Clients of Player complain of a round that ends without data.
TEST_CASE("a round of pull mode ends with data, for which it waits", "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("00000005");
  (void)desk.say("00000001 00000000 00000003 00000005", "00000002");
  const std::string ask = "00000001 00000000 00000003 00000004";
  CHECK(desk.say(ask).size() == 40);  // the answer alone
  const Bytes round = desk.pass(350ms);
  REQUIRE(round.size() == 56 + 40);  // once, although data have come three times
  CHECK(in_words(std::span(round).subspan(56 + 8, 16)) == "00000001 00000000 00000005 00000001");
}

TEST_CASE("a Player server says which messages a device knows", "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("00000004");
  const std::string ask = "00000004 00000000 00000003 000000FF";
  CHECK(Parts(desk.say(ask, "00000002 00000001")).head.ends_with("00000004 000000FF"));
  CHECK(Parts(desk.say(ask, "00000002 00000002")).head.ends_with("00000006 000000FF"));
}

TEST_CASE("a Player server refuses requests that it does not know, without a word more", "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("00000004");
  for (const std::string request :
       {"00000004 00000000 00000003 00000063", "00000001 00000000 00000003 00000063",
        "00000004 00000000 00000003 00000002"}) {  // motors, without a payload
    const Parts answer(desk.say(request));
    CHECK(answer.head.ends_with("00000006 " + request.substr(27)));
    CHECK(answer.tail.ends_with("00000000"));
    CHECK(answer.payload.empty());
  }
}

TEST_CASE("a Player server drops what no open device knows, and hears the rest", "[emulators]") {
  ConnectedDesk desk;
  CHECK(desk.say(kMotorsOn, "00000001").empty());  // not open
  (void)desk.open("00000004");
  (void)desk.say(kMotorsOn, "00000001");
  (void)desk.say(kVelocity, "7FF8000000000000 0000000000000000 0000000000000000 00000001");  // not a number
  CHECK(desk.body.told == Twist2{});
  CHECK(desk.server.dropped() == 2);
  desk.server.take(from_words(std::string(80, 'F')), 0, desk.now);  // no header
  CHECK(desk.server.dropped() == 3);
  (void)desk.say(kVelocity, kAheadLeft);
  CHECK(desk.body.told == Twist2{0.2, 0.0, 0.1});
}

TEST_CASE("messages to a Player server may come byte by byte", "[emulators]") {
  ConnectedDesk desk;
  const Bytes message = from_words(
      "00000000 00000000 00000001 00000000 00000003 00000005 0000000000000000 00000007 00000004 00000001");
  for (std::size_t i = 0; i + 1 < message.size(); ++i) {
    desk.server.take(std::span(message).subspan(i, 1), 0, desk.now);
    REQUIRE(desk.server.advance(desk.now).empty());
  }
  desk.server.take(std::span(message).last(1), 0, desk.now);
  CHECK(Parts(desk.server.advance(desk.now)).tail == "00000007 00000000");
}

TEST_CASE("a Player server that is started anew greets its client again and has stopped the base",
          "[emulators]") {
  ConnectedDesk desk;
  (void)desk.open("00000004");
  (void)desk.say(kMotorsOn, "00000001");
  (void)desk.say(kVelocity, kAheadLeft);
  desk.server.reset(desk.now);
  CHECK(desk.body.told == Twist2{});
  CHECK(in_words(desk.pass(100ms)) == kBanner);
}
