// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "orca/base/random.hpp"
#include "scout_bytes.hpp"

using namespace orca::hw;
using nomad_scout::Type;
using test::Bytes;
using test::hex;
using Packets = std::vector<std::string>;

namespace {

const std::string kGetState = "01 02 00 07 0A 5C";
const std::string kWatchdog = "01 03 00 12 05 1B 5C";

Packets packets_in(const Bytes& bytes) { return test::frames_in(nomad_scout::kProtocol, bytes); }

}  // namespace

TEST_CASE("a Scout's packet is start, length, type, payload, sum and end", "[hw][scout]") {
  CHECK(test::text_of(nomad_scout::make_packet(Type::get_state).view()) == kGetState);
  CHECK(test::text_of(nomad_scout::make_packet(Type::set_watchdog, hex("05")).view()) == kWatchdog);
  const test::HeldMessage held(hex(kWatchdog));
  CHECK(held.message.type == Type::set_watchdog);
  CHECK(test::text_of(held.message.payload) == "05");
}

TEST_CASE("a Scout's packet is found one byte at a time", "[hw][scout]") {
  test::FrameList list(nomad_scout::kProtocol);
  for (const std::uint8_t byte : hex(test::kStateAnswer)) {
    CHECK(list.frames().empty());
    list.hear({byte});
  }
  CHECK(list.frames() == Packets{test::kStateAnswer});
}

TEST_CASE("two packets of a Scout in one read are both found", "[hw][scout]") {
  CHECK(packets_in(hex(kWatchdog + " " + kGetState)) == Packets{kWatchdog, kGetState});
}

TEST_CASE("a packet of a Scout is found behind noise and behind another start byte", "[hw][scout]") {
  CHECK(packets_in(hex("57 4D 0D 01 01 01 " + kGetState)) == Packets{kGetState});
}

TEST_CASE("a packet of a Scout with a wrong sum or end is dropped and the next one found", "[hw][scout]") {
  test::FrameList list(nomad_scout::kProtocol);
  list.hear(hex("01 03 00 12 05 1C 5C " + kGetState));
  CHECK(list.frames() == Packets{kGetState});
  CHECK(list.statistics().bad_checksums == 1);
  list.hear(hex("01 03 00 12 05 1B 5D " + kWatchdog));
  CHECK(list.frames() == Packets{kGetState, kWatchdog});
}

TEST_CASE("lengths that no packet of a Scout has are no beginning", "[hw][scout]") {
  for (const std::string length : {"00 00", "01 00", "02 01", "FF FF"}) {
    INFO(length);
    CHECK(packets_in(hex("01 " + length + " " + kGetState)) == Packets{kGetState});
  }
}

TEST_CASE("an answer that hides behind a false length is found when the driver gives up waiting",
          "[hw][scout]") {
  test::FrameList list(nomad_scout::kProtocol);
  list.hear(hex("01 F0 00 " + test::kStateAnswer));
  CHECK(list.frames().empty());
  list.give_up();
  CHECK(list.frames() == Packets{test::kStateAnswer});
}

TEST_CASE("one flipped bit anywhere in a packet of a Scout makes it no packet", "[hw][scout]") {
  const Bytes whole = hex(test::kStateAnswer);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    Bytes flipped = whole;
    flipped[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    INFO(bit);
    CHECK(nomad_scout::look(flipped).kind != framing::Finding::Kind::frame);
  }
}

TEST_CASE("any payload comes out of a Scout's packet as it went in", "[hw][scout]") {
  orca::RandomStream random(1, "test", "scout packets");
  for (int round = 0; round < 2000; ++round) {
    Bytes payload(random() % (nomad_scout::kLongestPayload + 1));
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random() & 0xFF);
    const nomad_scout::Packet packet = nomad_scout::make_packet(static_cast<Type>(random() & 0xFF), payload);
    REQUIRE(nomad_scout::look(packet.view()).kind == framing::Finding::Kind::frame);
    CHECK(test::text_of(nomad_scout::message_of(packet.view()).payload) == test::text_of(payload));
  }
}
