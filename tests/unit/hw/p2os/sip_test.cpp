// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <string>

#include "hex_bytes.hpp"
#include "orca/base/random.hpp"
#include "orca/hw/p2os/sip.hpp"

using namespace orca::hw;
using p2os::Sip;
using test::Bytes;
using test::hex;

namespace {

constexpr double kDegreesOfSip = std::numbers::pi / 180.0;

const p2os::Model& pioneer() { return p2os::choose_model("p2dx").model; }

Sip sip_in(const std::string& packet) {
  const Bytes bytes = hex(packet);
  REQUIRE(p2os::look(bytes).kind == framing::Finding::Kind::frame);
  REQUIRE(p2os::look(bytes).size == bytes.size());
  return p2os::parse_sip(p2os::body_of(bytes), pioneer()).value();
}

const std::string kMovingSip =
    "FA FB 27 33 A6 04 89 7F 00 04 BE 00 D2 00 7E 00 00 00 04 01 00 2D 04 00 93 0E 01 93 0E 02 52 17 03 E1 "
    "48 00 "
    "00 80 0F 01 07 92";
const std::string kStoppedSip =
    "FA FB 1B 32 00 00 00 00 00 FE 00 00 00 00 77 03 05 00 FE 00 00 00 00 00 00 00 00 00 34 7A";
const std::string kTailSip =
    "FA FB 20 32 FF 7F 05 00 00 00 00 00 00 00 77 00 00 00 00 01 00 00 00 00 00 00 00 00 77 00 00 00 00 B3 "
    "F2";

// The body of a SIP that stands at the origin, with no sonar and no ports.
Bytes bare() { return hex("32 00 00 00 00 00 00 00 00 00 00 7E 00 00 00 00 00 00 00 00"); }

}  // namespace

TEST_CASE("a SIP of a moving Pioneer is read in SI units", "[hw][p2os]") {
  const Sip sip = sip_in(kMovingSip);
  CHECK(sip.x == 1190);
  CHECK(sip.y == 32649);
  CHECK(sip.heading == Approx(1.5708).margin(0.0001));
  CHECK(sip.left_speed == Approx(0.190));
  CHECK(sip.right_speed == Approx(0.210));
  CHECK(sip.battery_voltage == Approx(12.6));
  CHECK_FALSE(sip.left_stall);
  CHECK_FALSE(sip.right_stall);
  CHECK(sip.motors_enabled);
  CHECK_FALSE(sip.emergency_stop);
  CHECK(sip.sonar_groups == 0);
}

TEST_CASE("a SIP carries the sonars that are new, and the ports", "[hw][p2os]") {
  const Sip sip = sip_in(kMovingSip);
  REQUIRE(sip.echoes.size() == 4);
  CHECK(sip.echoes[0].range == Approx(0.9999).margin(0.00005));
  CHECK(sip.echoes[1].index == 1);
  CHECK(sip.echoes[1].range == sip.echoes[0].range);
  CHECK(sip.echoes[2].range == Approx(1.6000).margin(0.00005));
  CHECK(sip.echoes[3].index == 3);
  CHECK(sip.echoes[3].range == Approx(5.0001).margin(0.00005));
  REQUIRE(sip.ports.has_value());
  CHECK(sip.ports->digital_in == 0x0F);
  CHECK_FALSE(sip.tail.real_battery_voltage.has_value());
}

TEST_CASE("a SIP of a stopped Pioneer tells stalls and bumpers apart", "[hw][p2os]") {
  const Sip sip = sip_in(kStoppedSip);
  CHECK(sip.heading == Approx(-45 * kDegreesOfSip));
  CHECK(sip.battery_voltage == Approx(11.9));
  CHECK(sip.left_stall);
  CHECK(sip.right_stall);
  CHECK(sip.rear_bumpers == 0b1);
  CHECK(sip.front_bumpers == 0b10);  // bit 2 of the byte, whose bit 0 is the stall
  CHECK_FALSE(sip.motors_enabled);
  CHECK(sip.echoes.empty());
}

TEST_CASE("fields of newer firmware are read as far as the packet goes", "[hw][p2os]") {
  const Sip sip = sip_in(kTailSip);
  CHECK(sip.x == 32767);
  CHECK(sip.y == 5);
  CHECK(sip.ports.has_value());
  CHECK(sip.tail.real_battery_voltage.value() == Approx(11.9));
  CHECK(sip.tail.charge_state == 0);
  CHECK_FALSE(sip.tail.state_of_charge.has_value());
}

TEST_CASE("every optional field appears with its last byte", "[hw][p2os]") {
  Bytes body = bare();
  const Bytes tail = hex("02 11 FF 01 02  83 00 03 9C FF 34 12 0C FE E7 55 78 56 34 12 EF BE AD DE");
  const auto read = [&](std::size_t count) {
    Bytes cut = body;
    cut.insert(cut.end(), tail.begin(), tail.begin() + static_cast<std::ptrdiff_t>(count));
    return p2os::parse_sip(cut, pioneer()).value();
  };
  CHECK_FALSE(read(4).ports.has_value());
  CHECK(read(5).ports->gripper == 0x11);
  CHECK_FALSE(read(6).tail.real_battery_voltage.has_value());
  CHECK(read(7).tail.real_battery_voltage.value() == Approx(13.1));
  CHECK(read(8).tail.charge_state == 3);
  CHECK_FALSE(read(14).tail.temperature.has_value());
  CHECK(read(15).tail.temperature == -25.0);
  CHECK_FALSE(read(15).tail.state_of_charge.has_value());
  CHECK(read(16).tail.state_of_charge == 0x55);
  CHECK(read(24).tail.state_of_charge == 0x55);
}

TEST_CASE("a controller without a sensor for it has no temperature", "[hw][p2os]") {
  Bytes body = bare();
  const Bytes tail = hex("02 11 FF 01 02  83 00 03 9C FF 34 12 0C FE 80");
  body.insert(body.end(), tail.begin(), tail.end());
  CHECK_FALSE(p2os::parse_sip(body, pioneer()).value().tail.temperature.has_value());
}

TEST_CASE("flags tell of motors, groups of sonars and the emergency stop", "[hw][p2os]") {
  Bytes body = bare();
  body[16] = 0x2B;
  const Sip sip = p2os::parse_sip(body, pioneer()).value();
  CHECK(sip.motors_enabled);
  CHECK(sip.sonar_groups == 0b0101);
  CHECK(sip.emergency_stop);
}

TEST_CASE("coordinates have 15 bits; the highest is ignored", "[hw][p2os]") {
  Bytes body = bare();
  body[2] = 0x81;
  CHECK(p2os::parse_sip(body, pioneer()).value().x == 0x0100);
}

TEST_CASE("speeds of an AmigoBot are in its own unit", "[hw][p2os]") {
  Bytes body = bare();
  body[7] = 0xE8;
  body[8] = 0x03;
  CHECK(p2os::parse_sip(body, p2os::choose_model("amigo").model).value().left_speed == Approx(0.6154));
}

TEST_CASE("all types of SIPs that are in use are read, and no others", "[hw][p2os]") {
  for (int type = 0; type < 256; ++type) {
    Bytes body = bare();
    body[0] = static_cast<std::uint8_t>(type);
    const auto sip = p2os::parse_sip(body, pioneer());
    INFO(type);
    CHECK(sip.has_value() == (type >= 0x30 && type <= 0x34));
    if (!sip) CHECK(sip.error().code == orca::Code::invalid_argument);
  }
}

TEST_CASE("a SIP that ends too early is refused with both sizes", "[hw][p2os]") {
  Bytes body = bare();
  body.pop_back();
  const auto sip = p2os::parse_sip(body, pioneer());
  REQUIRE_FALSE(sip.has_value());
  CHECK(sip.error().code == orca::Code::data_loss);
  CHECK(sip.error().message == "a SIP of 19 bytes, which should have at least 20; it is not used");
}

TEST_CASE("a SIP that promises more sonars than it has is refused", "[hw][p2os]") {
  Bytes body = bare();
  body[19] = 2;
  body.insert(body.end(), {0, 1, 2, 3, 4});
  CHECK(p2os::parse_sip(body, pioneer()).error().message ==
        "a SIP of 25 bytes, which should have at least 26; it is not used");
  body.push_back(5);
  CHECK(p2os::parse_sip(body, pioneer()).value().echoes.size() == 2);
}

TEST_CASE("a SIP can hold as many echoes as fit into a packet", "[hw][p2os]") {
  Bytes body = bare();
  body[19] = static_cast<std::uint8_t>(Sip::kMostEchoes);
  body.resize(p2os::kLongestBody);
  CHECK(p2os::parse_sip(body, pioneer()).value().echoes.size() == 77);
}

TEST_CASE("any bytes of the type of a SIP give a SIP or an error", "[hw][p2os]") {
  orca::RandomStream random(1, "test", "p2os sips");
  int read = 0;
  for (int round = 0; round < 5000; ++round) {
    Bytes body(1 + random() % p2os::kLongestBody);
    for (auto& byte : body) byte = static_cast<std::uint8_t>(random() & 0xFF);
    body[0] = 0x32;
    if (body.size() > 19) body[19] %= 100;
    const auto sip = p2os::parse_sip(body, pioneer());
    const bool is_long_enough = body.size() >= 20 && body.size() >= 20U + 3U * body[19];
    REQUIRE(sip.has_value() == is_long_enough);
    if (sip) CHECK(sip->echoes.size() == body[19]);
    read += sip.has_value();
  }
  CHECK(read > 1000);
}
