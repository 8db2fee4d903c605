// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/player/message_reader.hpp"

#include <malloc.h>

#include <catch2/catch.hpp>

#include <algorithm>

#include "orca/hw/player/position2d.hpp"
#include "orca/hw/player/sensors.hpp"
#include "orca/hw/player/session.hpp"
#include "player_bytes.hpp"

using namespace orca::hw::player;
using namespace orca::hw::player::test;

namespace {

const Bytes kModeMessage = words(
    "00000000 00000000 00000001 00000000 00000003 00000005 0000000000000000 00000000 00000004 | 00000002");
const Bytes kListMessage =
    words("00000000 00000000 00000001 00000000 00000003 00000001 0000000000000000 00000000 00000000");

// A reader with a list of what it has read.
class Listener {
 public:
  explicit Listener(MessageReader::Side side) : reader(side) {}
  orca::Status hear(std::span<const std::uint8_t> bytes) {
    return reader.feed(bytes, [this](const Message& message) {
      ids.push_back(id_of(message.header));
      payloads.emplace_back(message.payload.begin(), message.payload.end());
    });
  }

  MessageReader reader;
  std::vector<MessageId> ids;
  std::vector<Bytes> payloads;
};

Bytes after_each_other(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Bytes banner_bytes() {
  const auto banner = make_banner("3.1.1-dev");
  return Bytes(banner.begin(), banner.end());
}

// [bytes] taken from the heap; 0 with sanitizers, which have a heap of their own.
std::size_t memory_taken() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace

TEST_CASE("a server reads messages however they are cut", "[hw][player]") {
  const Bytes stream = after_each_other({kModeMessage, kListMessage, kModeMessage});
  for (std::size_t piece = 1; piece <= stream.size(); ++piece) {
    Listener server(MessageReader::Side::server);
    for (std::size_t at = 0; at < stream.size(); at += piece)
      CHECK(server.hear(std::span(stream).subspan(at, std::min(piece, stream.size() - at))).ok());
    CHECK(server.ids == std::vector<MessageId>{kSetDataMode, kListDevices, kSetDataMode});
    CHECK(server.payloads == std::vector<Bytes>{words("00000002"), {}, words("00000002")});
    CHECK(server.reader.waiting() == 0);
  }
}

TEST_CASE("a message without a payload is read with the last byte of its header", "[hw][player]") {
  Listener server(MessageReader::Side::server);
  CHECK(server.hear(std::span(kListMessage).first(39)).ok());
  CHECK(server.ids.empty());
  CHECK(server.reader.waiting() == 39);
  CHECK(server.hear(std::span(kListMessage).subspan(39)).ok());
  CHECK(server.ids == std::vector<MessageId>{kListDevices});
}

TEST_CASE("a client reads the banner first", "[hw][player]") {
  Listener client(MessageReader::Side::client);
  const Bytes stream = after_each_other({banner_bytes(), kListMessage});
  CHECK(client.hear(std::span(stream).first(31)).ok());
  CHECK(client.reader.server_version().empty());
  CHECK(client.hear(std::span(stream).subspan(31)).ok());
  CHECK(client.reader.server_version() == "3.1.1-dev");
  CHECK(client.ids == std::vector<MessageId>{kListDevices});
}

TEST_CASE("a client reads banner and messages byte by byte", "[hw][player]") {
  Listener client(MessageReader::Side::client);
  for (const std::uint8_t byte : after_each_other({banner_bytes(), kListMessage, kModeMessage}))
    REQUIRE(client.hear(Bytes{byte}).ok());
  CHECK(client.ids == std::vector<MessageId>{kListDevices, kSetDataMode});
}

TEST_CASE("a client that reaches another server says so", "[hw][player]") {
  Listener client(MessageReader::Side::client);
  const orca::Status heard = client.hear(Bytes(32, 'x'));
  REQUIRE_FALSE(heard.ok());
  CHECK(heard.error().message.find("check host and port") != std::string::npos);
}

TEST_CASE("after a wrong header nothing is read any more", "[hw][player]") {
  Bytes wrong = kListMessage;
  wrong[19] = 9;  // message type
  Listener server(MessageReader::Side::server);
  const orca::Status first = server.hear(after_each_other({kModeMessage, wrong, kModeMessage}));
  REQUIRE_FALSE(first.ok());
  CHECK(server.ids == std::vector<MessageId>{kSetDataMode});
  const orca::Status second = server.hear(kModeMessage);
  REQUIRE_FALSE(second.ok());
  CHECK(second.error().message == first.error().message);
  CHECK(server.ids.size() == 1);
}

TEST_CASE("a promise of 8 MiB takes memory only for what arrives", "[hw][player]") {
  const Bytes header =
      words("00000000 00000000 00000001 00000000 00000001 00000001 0000000000000000 00000000 007FFFD8");
  Listener server(MessageReader::Side::server);
  const std::size_t before = memory_taken();
  CHECK(server.hear(header).ok());
  CHECK(server.hear(Bytes(100)).ok());
  CHECK(memory_taken() < before + 10'000);
  CHECK(server.reader.waiting() == 140);
  CHECK(server.hear(Bytes(kLongestPayload - 100)).ok());
  CHECK(server.reader.waiting() == 0);
  REQUIRE(server.payloads.size() == 1);
  CHECK(server.payloads[0].size() == kLongestPayload);
}

TEST_CASE("a session of a client and a server, each with its reader", "[hw][player]") {
  Listener server(MessageReader::Side::server);
  Listener client(MessageReader::Side::client);
  CHECK(client.hear(banner_bytes()).ok());
  const Address base{.interface = Interface::position2d};
  CHECK(server.hear(make_message(header_for(kSubscribe), encode(Subscription{.device = base})).value()).ok());
  REQUIRE(server.ids == std::vector<MessageId>{kSubscribe});
  const auto wish = decode<Subscription>(server.payloads[0]).value();
  CHECK(wish == Subscription{base, Access::open, ""});
  const Subscription granted{wish.device, Access::open, "orca"};
  const Header ack = answer_to(header_for(kSubscribe), MessageType::ack);
  CHECK(client.hear(make_message(ack, encode(granted)).value()).ok());
  CHECK(
      client.hear(make_message(header_for(kPosition2dState), encode(Position2dState{.stall = true})).value())
          .ok());
  REQUIRE(client.ids == std::vector<MessageId>{{Interface::player, MessageType::ack, 3}, kPosition2dState});
  CHECK(decode<Subscription>(client.payloads[0]).value() == granted);
  CHECK(decode<Position2dState>(client.payloads[1]).value().stall);
}
