// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "orca/base/random.hpp"
#include "orca/hw/nomad_scout/command.hpp"
#include "orca/hw/nomad_scout/number.hpp"
#include "scout_bytes.hpp"

using namespace orca::hw;
using namespace orca::hw::nomad_scout;
using namespace std::chrono_literals;
using test::Bytes;
using test::hex;

namespace {

constexpr double kUnit = 0.00254;  // [m] a tenth of an inch

std::string line(const Packet& packet) { return test::text_of(packet.view()); }
std::string payload_line(const Packet& packet) { return test::text_of(message_of(packet.view()).payload); }

}  // namespace

TEST_CASE("commands of a Scout without an argument are a type", "[hw][scout]") {
  CHECK(line(get_state()) == "01 02 00 07 0A 5C");
  CHECK(line(stop()) == "01 02 00 09 0C 5C");
  CHECK(line(limp()) == "01 02 00 0A 0D 5C");
  CHECK(line(zero()) == "01 02 00 0D 10 5C");
  CHECK(line(get_group(Type::get_sonars)) == "01 02 00 14 17 5C");
  CHECK(line(get_group(Type::get_position)) == "01 02 00 15 18 5C");
  CHECK(line(get_group(Type::get_velocities)) == "01 02 00 16 19 5C");
  CHECK(line(get_group(Type::get_bumpers)) == "01 02 00 1B 1E 5C");
}

TEST_CASE("accelerations, speeds and distances are in tenths of an inch", "[hw][scout]") {
  CHECK(line(set_accelerations({300 * kUnit, 300 * kUnit})) == "01 08 00 01 2C 01 2C 01 00 00 64 5C");
  CHECK(line(set_speeds({100 * kUnit, 100 * kUnit})) == "01 08 00 02 64 00 64 00 00 00 D3 5C");
  CHECK(line(nomad_scout::move({400 * kUnit, 400 * kUnit})) == "01 08 00 03 90 01 90 01 00 00 2E 5C");
}

TEST_CASE("the right wheel comes first, so that a faster right wheel turns the robot to the left",
          "[hw][scout]") {
  CHECK(line(drive({.left = 95 * kUnit, .right = 105 * kUnit})) == "01 08 00 05 69 00 5F 00 00 00 D6 5C");
  CHECK(payload_line(set_speeds({.left = 1 * kUnit, .right = 2 * kUnit})) == "02 00 01 00 00 00");
  CHECK(payload_line(set_accelerations({.left = 1 * kUnit, .right = 2 * kUnit})) == "02 00 01 00 00 00");
  CHECK(payload_line(nomad_scout::move({.left = -1 * kUnit, .right = 2 * kUnit})) == "02 00 01 80 00 00");
}

TEST_CASE("speeds backward have a sign bit", "[hw][scout]") {
  CHECK(line(drive({-50 * kUnit, -50 * kUnit})) == "01 08 00 05 32 80 32 80 00 00 72 5C");
}

TEST_CASE("a speed that is no number stops its wheel, and a huge one keeps its sign", "[hw][scout]") {
  CHECK(payload_line(drive({std::nan(""), std::nan("")})) == "00 00 00 00 00 00");
  CHECK(payload_line(drive({.left = -1e9, .right = 1e9})) == "FF 7F FF FF 00 00");
}

TEST_CASE("accelerations and speeds of a move have no sign", "[hw][scout]") {
  CHECK(line(set_accelerations({-300 * kUnit, 300 * kUnit})) ==
        line(set_accelerations({300 * kUnit, 300 * kUnit})));
}

TEST_CASE("position and angles are defined", "[hw][scout]") {
  CHECK(line(define_position(0.0, 0.0)) == "01 06 00 0C 00 00 00 00 13 5C");
  CHECK(payload_line(define_position(2 * kUnit, -3 * kUnit)) == "02 00 03 80");
  CHECK(line(define_angles(std::numbers::pi / 2)) == "01 06 00 1E 84 03 00 00 AC 5C");
}

TEST_CASE("the watchdog has whole seconds, rounded up so that a short limit does not switch it off",
          "[hw][scout]") {
  CHECK(line(set_watchdog(5s)) == "01 03 00 12 05 1B 5C");
  CHECK(payload_line(set_watchdog(200ms)) == "01");
  CHECK(payload_line(set_watchdog(1001ms)) == "02");
  CHECK(payload_line(set_watchdog(0s)) == "00");
  CHECK(payload_line(set_watchdog(1h)) == "FF");
}

TEST_CASE("sonars fire in an order, at an interval in steps of 4 ms", "[hw][scout]") {
  CHECK(line(start_sonars(60ms, Bytes{0, 2, 15, 1, 14, 3, 13, 4, 12, 5, 11, 6, 10, 7, 9, 8})) ==
        "01 13 00 0F 0F 00 02 0F 01 0E 03 0D 04 0C 05 0B 06 0A 07 09 08 AA 5C");
  CHECK(payload_line(start_sonars(1ms, Bytes{0, 1, 15})) ==
        "01 00 01 0F FF FF FF FF FF FF FF FF FF FF FF FF FF");
  CHECK(payload_line(start_sonars(10s, Bytes(20, 3))) ==
        "FF 03 03 03 03 03 03 03 03 03 03 03 03 03 03 03 03");
  CHECK(payload_line(stop_sonars()) == "00 FF FF FF FF FF FF FF FF FF FF FF FF FF FF FF FF");
}

TEST_CASE("waiting names the axes and a time", "[hw][scout]") {
  CHECK(line(wait_until_stopped(true, true, 5s)) == "01 06 00 1F 01 01 00 05 2D 5C");
  CHECK(payload_line(wait_until_stopped(false, true, 1500ms)) == "00 01 00 02");
}

TEST_CASE("each axis may have a mode of its own", "[hw][scout]") {
  const std::array<Axis, 3> axes{{{AxisMode::velocity, 100}, {AxisMode::velocity, 100}, {}}};
  CHECK(line(set_axes(axes)) == "01 0E 00 2B 01 00 64 00 01 00 64 00 00 00 00 00 04 5C");
  CHECK(payload_line(set_axes({{{AxisMode::relative_position, -5}, {AxisMode::max_torque, 7}, {}}})) ==
        "02 00 05 80 08 00 07 00 00 00 00 00");
}

TEST_CASE("ports of the controller get a rate", "[hw][scout]") {
  CHECK(payload_line(configure_port(1, 38400)) == "01 00 96");
}

TEST_CASE("a special packet carries any bytes that fit", "[hw][scout]") {
  CHECK(payload_line(special(hex("01 5C")).value()) == "01 5C");
  CHECK(special(Bytes(253)).value().size() == kLongestPacket);
  CHECK(special(Bytes(254)).error().message ==
        "a special packet with 254 bytes; the robot takes at most 253; send them in parts");
}

TEST_CASE("any speeds come out of a command as they went in, within a unit", "[hw][scout]") {
  orca::RandomStream random(1, "test", "scout speeds");
  for (int round = 0; round < 1000; ++round) {
    const Wheels sent{random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5)};
    const Packet packet = drive(sent);
    const auto payload = message_of(packet.view()).payload;
    const auto number = [&](std::size_t at) {
      return from_sign_and_magnitude(static_cast<std::uint16_t>(payload[at] + 256U * payload[at + 1]));
    };
    CHECK(number(0) * kUnit == Approx(sent.right).margin(0.51 * kUnit));
    CHECK(number(2) * kUnit == Approx(sent.left).margin(0.51 * kUnit));
    CHECK(number(4) == 0);
  }
}
