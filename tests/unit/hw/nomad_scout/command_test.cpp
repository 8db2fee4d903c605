// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <string>

#include "orca/base/random.hpp"
#include "orca/hw/nomad_scout/base.hpp"
#include "orca/hw/nomad_scout/command.hpp"
#include "scout_bytes.hpp"

using namespace orca::hw;
using namespace orca::hw::nomad_scout;
using namespace std::chrono_literals;
using test::Bytes;

namespace {

constexpr double kUnit = 0.00254;  // [m] a tenth of an inch

std::string line(const Packet& packet) { return test::text_of(packet.view()); }
std::string payload_line(const Packet& packet) { return test::text_of(message_of(packet.view()).payload); }

}  // namespace

TEST_CASE("commands of a Scout without an argument are a type", "[hw][scout]") {
  CHECK(line(get_state()) == "01 02 00 07 0A 5C");
  CHECK(line(stop()) == "01 02 00 09 0C 5C");
  CHECK(line(limp()) == "01 02 00 0A 0D 5C");
}

TEST_CASE("accelerations are in tenths of an inch", "[hw][scout]") {
  CHECK(line(set_accelerations({300 * kUnit, 300 * kUnit})) == "01 08 00 01 2C 01 2C 01 00 00 64 5C");
}

TEST_CASE("the right wheel comes first, so that a faster right wheel turns the robot to the left",
          "[hw][scout]") {
  CHECK(line(drive({.left = 95 * kUnit, .right = 105 * kUnit})) == "01 08 00 05 69 00 5F 00 00 00 D6 5C");
  CHECK(payload_line(set_accelerations({.left = 1 * kUnit, .right = 2 * kUnit})) == "02 00 01 00 00 00");
}

TEST_CASE("speeds backward have a sign bit", "[hw][scout]") {
  CHECK(line(drive({-50 * kUnit, -50 * kUnit})) == "01 08 00 05 32 80 32 80 00 00 72 5C");
}

TEST_CASE("a speed that is no number stops its wheel, and a huge one keeps its sign", "[hw][scout]") {
  CHECK(payload_line(drive({std::nan(""), std::nan("")})) == "00 00 00 00 00 00");
  CHECK(payload_line(drive({.left = -1e9, .right = 1e9})) == "FF 7F FF FF 00 00");
}

TEST_CASE("accelerations have no sign", "[hw][scout]") {
  CHECK(line(set_accelerations({-300 * kUnit, 300 * kUnit})) ==
        line(set_accelerations({300 * kUnit, 300 * kUnit})));
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
