// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/hw/player/session.hpp"
#include "player_bytes.hpp"

using namespace orca::hw::player;
using namespace orca::hw::player::test;

TEST_CASE("a request for pull mode has the bytes that libplayerc sends", "[hw][player]") {
  const auto message =
      make_message(header_for(kSetDataMode), encode(DataMode{.mode = DataMode::Mode::pull})).value();
  CHECK(message ==
        words("00000000 00000000 00000001 00000000 00000003 00000005 0000000000000000 00000000 00000004"
              "| 00000002"));
}

TEST_CASE("a request for the list of devices is a header alone", "[hw][player]") {
  CHECK(make_message(header_for(kListDevices)).value() ==
        words("00000000 00000000 00000001 00000000 00000003 00000001 0000000000000000 00000000 00000000"));
}

TEST_CASE("a header is read field by field", "[hw][player]") {
  const auto header = decode_header(
      words("0100007F 00004119 00000004 00000002 00000006 000000FF 3FE0000000000000 00000007 00000034"));
  REQUIRE(header.has_value());
  CHECK(header->address == Address{0x0100007F, 0x4119, Interface::position2d, 2});
  CHECK(header->type == MessageType::nack);
  CHECK(header->subtype == 255);
  CHECK(header->time == 0.5);
  CHECK(header->sequence == 7);
  CHECK(header->size == 52);
  CHECK(id_of(*header) == MessageId{Interface::position2d, MessageType::nack, 255});
}

TEST_CASE("an answer has the address, the subtype and the sequence of its request", "[hw][player]") {
  const Header request{.address = captured(Interface::sonar),
                       .type = MessageType::request,
                       .subtype = 2,
                       .time = 1.0,
                       .sequence = 9,
                       .size = 4};
  const Header ack = answer_to(request, MessageType::ack);
  CHECK(ack == Header{captured(Interface::sonar), MessageType::ack, 2, 0.0, 9, 0});
  CHECK(id_of(ack) == MessageId{request.address.interface, MessageType::ack, request.subtype});
}

TEST_CASE("the size in a header is that of the payload", "[hw][player]") {
  Header header = header_for(kListDevices);
  header.size = 1000;
  const auto message = make_message(header, Bytes(3)).value();
  CHECK(message.size() == 43);
  CHECK(decode_header(message)->size == 3);
}

TEST_CASE("a header of an unknown message type is an error", "[hw][player]") {
  const std::string start = "00000000 00000000 00000001 00000000 ";
  const std::string end = " 00000001 0000000000000000 00000000 00000000";
  for (const std::string type : {"00000001", "00000006"})
    CHECK(decode_header(words(start + type + end)).has_value());
  for (const std::string type : {"00000000", "00000007", "80000001"})
    CHECK_FALSE(decode_header(words(start + type + end)).has_value());
  CHECK(error_of(decode_header(words(start + "00000007" + end))) ==
        "message type 7 does not exist in Player; close the connection and check that the peer speaks Player "
        "3.x");
}

TEST_CASE("a header that promises more than a message can have is an error", "[hw][player]") {
  const std::string start =
      "00000000 00000000 00000001 00000000 00000001 00000001 0000000000000000 00000000 ";
  CHECK(decode_header(words(start + "007FFFD8"))->size == kLongestPayload);
  CHECK(error_of(decode_header(words(start + "007FFFD9"))) ==
        "a payload of 8388569 bytes is announced, more than a Player message of 8 MiB can have; close the "
        "connection "
        "and check that the peer speaks Player 3.x");
  CHECK_FALSE(decode_header(words(start + "FFFFFFFF")).has_value());
}

TEST_CASE("a header that was cut short is an error", "[hw][player]") {
  CHECK(error_of(decode_header(Bytes(39))) == "a Player header has 40 bytes, but only 39 have arrived");
}

TEST_CASE("a message that is too long is not made", "[hw][player]") {
  CHECK(make_message(header_for(kListDevices), Bytes(kLongestPayload)).value().size() == 8388608);
  const auto refused = make_message(header_for(kListDevices), Bytes(kLongestPayload + 1));
  CHECK(error_of(refused) ==
        "a payload of 8388569 bytes does not fit into a Player message of 8 MiB; send less at a time");
}

TEST_CASE("the banner of a server is its version in 32 bytes", "[hw][player]") {
  const Bytes expected = words("506C6179 65722076 2E332E31 2E312D64 65760000 00000000 00000000 00000000");
  const auto banner = make_banner("3.1.1-dev");
  CHECK(Bytes(banner.begin(), banner.end()) == expected);
  CHECK(parse_banner(expected).value() == "3.1.1-dev");
}

TEST_CASE("a long version is cut so that the banner ends with a zero byte", "[hw][player]") {
  const auto banner = make_banner("3.1.1-with-a-very-long-suffix");
  CHECK(banner.back() == 0);
  CHECK(parse_banner(banner).value() == "3.1.1-with-a-very-long");
}

TEST_CASE("a server that is no Player server is named by what it says", "[hw][player]") {
  Bytes other{'S', 'S', 'H', '-', '2', '.', '0', '\r', '\n'};
  other.resize(32);
  CHECK(error_of(parse_banner(other)) ==
        "the server begins with \"SSH-2.0\\r\\n\" and not with \"Player v.\"; check host and port");
}

TEST_CASE("a banner that was cut short is an error", "[hw][player]") {
  const auto banner = make_banner("3.1.1");
  CHECK(error_of(parse_banner(std::span(banner).first(31))) ==
        "the banner of a Player server has 32 bytes, but only 31 have arrived");
}

TEST_CASE("a banner without a zero byte is read to its end", "[hw][player]") {
  const std::string text = "Player v.12345678901234567890123";
  CHECK(parse_banner(Bytes(text.begin(), text.end())).value() == "12345678901234567890123");
}
