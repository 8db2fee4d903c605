// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>

#include "hex_bytes.hpp"
#include "orca/hw/p2os/reports.hpp"

using namespace orca::hw;
using p2os::PacketType;
using test::Bytes;
using test::hex;

namespace {

Bytes body_in(const std::string& packet) {
  const Bytes bytes = hex(packet);
  REQUIRE(p2os::look(bytes).kind == framing::Finding::Kind::frame);
  const auto body = p2os::body_of(bytes);
  return {body.begin(), body.end()};
}

}  // namespace

TEST_CASE("an encoder packet has a signed count per wheel", "[hw][p2os]") {
  const auto report = p2os::parse_encoder(body_in("FA FB 0B 90 E8 03 00 00 18 FC FF FF 90 00"));
  CHECK(report == p2os::EncoderReport{1000, -1000});
}

TEST_CASE("an IO packet has three lists behind their sizes", "[hw][p2os]") {
  const auto report = p2os::parse_io(body_in("FA FB 0C F0 01 0F 01 01 02 00 02 FF 03 FF 09"));
  REQUIRE(report.has_value());
  CHECK(test::text_of(report->digital_in.view()) == "0F");
  CHECK(test::text_of(report->digital_out.view()) == "01");
  REQUIRE(report->analog.size() == 2);
  CHECK(report->analog[0] == 512);
  CHECK(report->analog[1] == 1023);
}

TEST_CASE("gyro readings are relative to standing still", "[hw][p2os]") {
  const auto report = p2os::parse_gyro(hex("98 03 00 02 1A FF 03 1B 00 00 1C"));
  REQUIRE(report.has_value());
  REQUIRE(report->size() == 3);
  CHECK((*report)[0] == p2os::GyroReading{0, 0x1A});
  CHECK((*report)[1] == p2os::GyroReading{511, 0x1B});
  CHECK((*report)[2] == p2os::GyroReading{-512, 0x1C});
}

TEST_CASE("bytes of auxiliary ports come as they are", "[hw][p2os]") {
  const Bytes first = hex("B0 01 FA FB");
  CHECK(test::text_of(p2os::parse_aux(first, PacketType::aux1).value()) == "01 FA FB");
  CHECK_FALSE(p2os::parse_aux(first, PacketType::aux2).has_value());
  CHECK(p2os::parse_aux(hex("B8"), PacketType::aux2).value().empty());
}

TEST_CASE("reports that are shorter than they say give nothing", "[hw][p2os]") {
  for (const std::string whole :
       {"90 E8 03 00 00 18 FC FF FF", "98 02 00 02 1A FF 03 1B", "F0 01 0F 01 01 02 00 02 FF 03"}) {
    const Bytes body = hex(whole);
    for (std::size_t size = 0; size < body.size(); ++size) {
      const auto cut = std::span(body).first(size);
      CHECK_FALSE(p2os::parse_encoder(cut).has_value());
      CHECK_FALSE(p2os::parse_gyro(cut).has_value());
      CHECK_FALSE(p2os::parse_io(cut).has_value());
    }
  }
}

TEST_CASE("a report of another type gives nothing", "[hw][p2os]") {
  CHECK_FALSE(p2os::parse_encoder(hex("91 E8 03 00 00 18 FC FF FF")).has_value());
  CHECK_FALSE(p2os::parse_gyro(hex("97 00")).has_value());
  CHECK_FALSE(p2os::parse_io(hex("F1 00 00 00")).has_value());
}

TEST_CASE("reports with empty lists are reports", "[hw][p2os]") {
  CHECK(p2os::parse_gyro(hex("98 00")).value().empty());
  CHECK(p2os::parse_io(hex("F0 00 00 00")) == p2os::IoReport{});
}
