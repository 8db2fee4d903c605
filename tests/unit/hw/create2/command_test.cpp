// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/create2/command.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <limits>

#include "orca/hw/create2/sensors.hpp"

using namespace orca::hw::create2;
using CommandBytes = std::vector<std::uint8_t>;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

CommandBytes sent(const Command& command) { return {command.begin(), command.end()}; }

}  // namespace

TEST_CASE("orders are one byte", "[hw][create2]") {
  CHECK(sent(encode(Order::start)) == CommandBytes{128});
  CHECK(sent(encode(Order::safe)) == CommandBytes{131});
  CHECK(sent(encode(Order::stop)) == CommandBytes{173});
}

TEST_CASE("of the wheel speeds the right one is sent first", "[hw][create2]") {
  CHECK(sent(drive_wheels({.left = -0.2, .right = 0.3})) == CommandBytes{145, 0x01, 0x2C, 0xFF, 0x38});
  CHECK(sent(drive_wheels({.left = 0.7, .right = -0.7})) == CommandBytes{145, 0xFE, 0x0C, 0x01, 0xF4});
}

TEST_CASE("a wheel speed is rounded to whole mm/s", "[hw][create2]") {
  CHECK(sent(drive_wheels({.left = 0.0014, .right = 0.0016})) == CommandBytes{145, 0, 2, 0, 1});
}

TEST_CASE("what is no number stands still", "[hw][create2]") {
  CHECK(sent(drive_wheels({kNoNumber, kNoNumber})) == CommandBytes{145, 0, 0, 0, 0});
  CHECK(wheel_speeds({.forward = kNoNumber}) == WheelSpeeds{});
  CHECK(wheel_speeds({.turn_rate = kInfinite}) == WheelSpeeds{});
  CHECK(wheel_speeds({.forward = 1.7e308, .turn_rate = 1.7e308}) == WheelSpeeds{});
}

TEST_CASE("a twist becomes wheel speeds by the wheel base", "[hw][create2]") {
  CHECK(wheel_speeds({.forward = 0.2}) == WheelSpeeds{0.2, 0.2});
  const WheelSpeeds turn = wheel_speeds({.forward = 0.1, .turn_rate = 1.0});
  CHECK(turn.left == Approx(-0.0175));
  CHECK(turn.right == Approx(0.2175));
}

TEST_CASE("a twist that is too fast keeps its arc", "[hw][create2]") {
  const WheelSpeeds fast = wheel_speeds({.forward = 0.8, .turn_rate = 2.0});
  CHECK(fast.right == Approx(0.5));
  CHECK(fast.left == Approx(0.5 * (0.8 - 0.235) / (0.8 + 0.235)));
  CHECK(wheel_speeds({.forward = -2.0}) == WheelSpeeds{-0.5, -0.5});
}

TEST_CASE("the manual's stream: left cliff signal and virtual wall", "[hw][create2]") {
  CHECK(sent(stream(std::array{Packet{29}, Packet{13}})) == CommandBytes{148, 2, 29, 13});
}
