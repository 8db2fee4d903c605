// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "hex_bytes.hpp"
#include "orca/base/random.hpp"
#include "orca/hw/p2os/packet.hpp"

using namespace orca::hw;
using test::Bytes;
using test::hex;
using Frames = std::vector<std::string>;
using p2os::Identity;

namespace {

const std::string kPulse = "FA FB 03 00 00 00";
const std::string kEnable = "FA FB 06 04 3B 01 00 05 3B";

Frames p2os_frames(const Bytes& bytes) { return test::frames_in(p2os::kProtocol, bytes); }

}  // namespace

TEST_CASE("a packet is header, length, body and checksum", "[hw][p2os]") {
  CHECK(test::text_of(p2os::make_packet(hex("04 3B 01 00")).view()) == kEnable);
  CHECK(test::text_of(p2os::body_of(hex(kEnable))) == "04 3B 01 00");
}

TEST_CASE("the longest body makes the longest packet, which is found again", "[hw][p2os]") {
  const p2os::Packet packet = p2os::make_packet(Bytes(p2os::kLongestBody, 0xFB));
  CHECK(packet.size() == p2os::kLongestPacket);
  CHECK(p2os_frames(Bytes(packet.begin(), packet.end())).size() == 1);
}

TEST_CASE("what a radio modem is told before the first packet is noise", "[hw][p2os]") {
  CHECK(p2os_frames(test::joined({hex("57 4D 53 32 0D"), hex(kPulse)})) == Frames{kPulse});
}

TEST_CASE("of two FA in a row the second may begin the packet", "[hw][p2os]") {
  CHECK(p2os_frames(test::joined({hex("FA"), hex(kEnable)})) == Frames{kEnable});
}

TEST_CASE("a packet of the Pioneer is found one byte at a time", "[hw][p2os]") {
  test::FrameList list(p2os::kProtocol);
  for (const std::uint8_t byte : hex(kEnable)) {
    CHECK(list.frames().empty());
    list.hear({byte});
  }
  CHECK(list.frames() == Frames{kEnable});
}

TEST_CASE("two packets of the Pioneer in one read are both found", "[hw][p2os]") {
  CHECK(p2os_frames(test::joined({hex(kEnable), hex(kPulse)})) == Frames{kEnable, kPulse});
}

TEST_CASE("a packet with a wrong checksum is dropped and the next one found", "[hw][p2os]") {
  test::FrameList list(p2os::kProtocol);
  list.hear(test::joined({hex("FA FB 06 04 3B 01 00 05 3A"), hex(kPulse)}));
  CHECK(list.frames() == Frames{kPulse});
  CHECK(list.statistics() == framing::Statistics{1, 1, 9, 1});
}

TEST_CASE("a packet inside one with a wrong checksum is found", "[hw][p2os]") {
  CHECK(p2os_frames(test::joined({hex("FA FB 08"), hex(kPulse), hex("12 34")})) == Frames{kPulse});
}

TEST_CASE("lengths without room for a body are no packets", "[hw][p2os]") {
  for (const std::string length : {"00", "01", "02"}) {
    INFO(length);
    CHECK(p2os_frames(test::joined({hex("FA FB " + length + " 00 00"), hex(kPulse)})) == Frames{kPulse});
  }
}

TEST_CASE("the end of the stream in mid-packet gives no packet", "[hw][p2os]") {
  const Bytes whole = hex(kEnable);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    test::FrameList list(p2os::kProtocol);
    list.hear(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    list.give_up();
    CHECK(list.frames().empty());
    CHECK(list.statistics().skipped_bytes == size);
  }
}

TEST_CASE("one flipped bit anywhere in a packet makes it no packet", "[hw][p2os]") {
  const Bytes whole = hex(kEnable);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    Bytes flipped = whole;
    flipped[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    test::FrameList list(p2os::kProtocol);
    list.hear(flipped);
    list.give_up();
    INFO(bit);
    CHECK(list.frames().empty());
  }
}

TEST_CASE("any body comes out of its packet as it went in", "[hw][p2os]") {
  orca::RandomStream random(1, "test", "p2os packets");
  for (int round = 0; round < 2000; ++round) {
    Bytes body(1 + random() % p2os::kLongestBody);
    for (auto& byte : body) byte = static_cast<std::uint8_t>(random() & 0xFF);
    const p2os::Packet packet = p2os::make_packet(body);
    const auto found = p2os::look(packet.view());
    REQUIRE(found.kind == framing::Finding::Kind::frame);
    REQUIRE(found.size == packet.size());
    CHECK(test::text_of(p2os::body_of(packet.view())) == test::text_of(body));
  }
}

TEST_CASE("the answer to SYNC2 gives name, class and subclass", "[hw][p2os]") {
  const auto packet =
      hex("FA FB 19 02 50 69 6F 6E 65 65 72 32 00 50 69 6F 6E 65 65 72 00 70 32 64 78 00 DD 7C");
  REQUIRE(p2os::look(packet).kind == framing::Finding::Kind::frame);
  CHECK(p2os::sync_step(p2os::body_of(packet)) == 2);
  CHECK(p2os::parse_identity(p2os::body_of(packet)) == Identity{"Pioneer2", "Pioneer", "p2dx"});
}

TEST_CASE("echoes of the handshake give their step, and nothing else does", "[hw][p2os]") {
  CHECK(p2os::sync_step(hex("00")) == 0);
  CHECK(p2os::sync_step(hex("01")) == 1);
  CHECK_FALSE(p2os::sync_step(hex("FF")).has_value());
  CHECK_FALSE(p2os::sync_step(hex("32 00")).has_value());
  CHECK_FALSE(p2os::sync_step({}).has_value());
  CHECK_FALSE(p2os::parse_identity(hex("01 41 00")).has_value());
}

TEST_CASE("names that are missing or not ended are read as far as they go", "[hw][p2os]") {
  CHECK(p2os::parse_identity(hex("02")) == Identity{"", "", ""});
  CHECK(p2os::parse_identity(hex("02 41 00 42 43")) == Identity{"A", "BC", ""});
  CHECK(p2os::parse_identity(hex("02 00 00 44 00 45")) == Identity{"", "", "D"});
}
