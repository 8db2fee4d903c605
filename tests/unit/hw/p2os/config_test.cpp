// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <numbers>

#include "hex_bytes.hpp"
#include "orca/hw/p2os/config.hpp"

using namespace orca::hw;
using namespace std::chrono_literals;
using p2os::Config;
using test::Bytes;
using test::hex;

namespace {

constexpr double kDegreesOfConfig = std::numbers::pi / 180.0;

// Written field by field after the list of the CONFIG packet.
Bytes whole_config() {
  return hex(
      "20 "
      "50 69 6F 6E 65 65 72 00 "  // class "Pioneer"
      "70 32 64 78 00 "           // subclass "p2dx"
      "41 37 00 "                 // serial number "A7"
      "01 "                       // not used
      "F4 01 98 08 2C 01 D0 07 "  // top: 500 deg/s, 2200 mm/s, 300 deg/s2, 2000 mm/s2
      "FF 01 "                    // most PWM 511
      "42 6F 62 00 "              // name "Bob"
      "64 02 01 "                 // SIP cycle 100 ms, host rate 2, aux1 rate 1
      "03 00 01 00 01 "           // gripper 3, front sonar, rear sonar
      "6E 00 "                    // low battery 11.0 V
      "E8 40 D0 07 "              // RevCount 16616, watchdog 2000 ms
      "01 2C 01 96 00 "           // two SIPs, stall value 300, stall count 150
      "F4 01 64 00 "              // joystick 500 mm/s, 100 deg/s
      "B4 00 E8 03 5A 00 3C 00 "  // 180 deg/s, 1000 mm/s, 90 and 60 deg/s2
      "28 00 14 00 05 00 "        // gains of turning 40, 20, 5
      "90 01 2C 01 "              // 400 and 300 mm/s2
      "1E 00 0F 00 02 00 "        // gains of driving 30, 15, 2
      "05 06 01 28 02 07 "        // bumpers 5 and 6, charger, sonar cycle 40 ms, resets its rate, gyro 7
      "F6 FF 03 04 "              // drift -10, aux2 rate 3, aux3 rate 4
      "91 00 66 00 "              // 145 ticks per mm, shutdown 102
      "32 2E 37 00 "              // firmware "2.7"
      "AA BB CC");                // fields newer than these
}

}  // namespace

TEST_CASE("a CONFIG packet gives limits, watchdog and battery in SI units", "[hw][p2os]") {
  const Config config = p2os::parse_config(whole_config()).value();
  CHECK(config.top_turn_rate == Approx(500 * kDegreesOfConfig));
  CHECK(config.top_speed == Approx(2.2));
  CHECK(config.watchdog == 2000ms);
  CHECK(config.low_battery_voltage == Approx(11.0));
  CHECK(config.resets_baud);
}

TEST_CASE("a CONFIG packet of any length is read, with zeros for what it does not have", "[hw][p2os]") {
  const Bytes whole = whole_config();
  for (std::size_t size = 1; size <= whole.size(); ++size) {
    INFO(size);
    const auto config = p2os::parse_config(std::span(whole).first(size));
    REQUIRE(config.has_value());
    CHECK((config->top_speed == Approx(2.2)) == (size >= 22));
    CHECK((config->watchdog == 2000ms) == (size >= 46));
    CHECK(config->resets_baud == (size >= 84));
  }
  CHECK_FALSE(p2os::parse_config({}).has_value());
  CHECK_FALSE(p2os::parse_config(hex("21 41 00")).has_value());
}
