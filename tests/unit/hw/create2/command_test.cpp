// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/create2/command.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "orca/hw/create2/sensors.hpp"

using namespace orca::hw::create2;
using CommandBytes = std::vector<std::uint8_t>;

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

CommandBytes sent(const Command& command) { return {command.begin(), command.end()}; }

std::string refusal(const orca::Result<Command>& result) {
  return result ? std::string() : result.error().text();
}

}  // namespace

TEST_CASE("orders are one byte", "[hw][create2]") {
  CHECK(sent(encode(Order::reset)) == CommandBytes{7});
  CHECK(sent(encode(Order::start)) == CommandBytes{128});
  CHECK(sent(encode(Order::safe)) == CommandBytes{131});
  CHECK(sent(encode(Order::full)) == CommandBytes{132});
  CHECK(sent(encode(Order::power)) == CommandBytes{133});
  CHECK(sent(encode(Order::dock)) == CommandBytes{143});
  CHECK(sent(encode(Order::stop)) == CommandBytes{173});
}

TEST_CASE("the manual's arc: in reverse at 200 mm/s while turning at a radius of 500 mm", "[hw][create2]") {
  CHECK(sent(drive(-0.2, 0.5)) == CommandBytes{137, 255, 56, 1, 244});
}

TEST_CASE("straight on is a radius of its own", "[hw][create2]") {
  CHECK(sent(drive(0.2, kInfinite)) == CommandBytes{137, 0, 200, 0x80, 0x00});
  CHECK(sent(drive(0.2, -kInfinite)) == CommandBytes{137, 0, 200, 0x80, 0x00});
}

TEST_CASE("an arc is limited in speed and radius", "[hw][create2]") {
  CHECK(sent(drive(2.0, -10.0)) == CommandBytes{137, 0x01, 0xF4, 0xF8, 0x30});
  CHECK(sent(drive(-kInfinite, 10.0)) == CommandBytes{137, 0xFE, 0x0C, 0x07, 0xD0});
}

TEST_CASE("a radius of 1 mm would mean to turn in place, so none is sent for an arc", "[hw][create2]") {
  CHECK(sent(drive(0.1, 0.001)) == CommandBytes{137, 0, 100, 0, 2});
  CHECK(sent(drive(0.1, 0.0)) == CommandBytes{137, 0, 100, 0, 2});
  CHECK(sent(drive(0.1, -0.0001)) == CommandBytes{137, 0, 100, 0xFF, 0xFE});
}

TEST_CASE("turning in place has the radius 1 to the left and -1 to the right", "[hw][create2]") {
  CHECK(sent(turn_in_place(0.1)) == CommandBytes{137, 0, 100, 0, 1});
  CHECK(sent(turn_in_place(-0.1)) == CommandBytes{137, 0, 100, 0xFF, 0xFF});
  CHECK(sent(turn_in_place(-9.0)) == CommandBytes{137, 0x01, 0xF4, 0xFF, 0xFF});
}

TEST_CASE("of the wheel speeds the right one is sent first", "[hw][create2]") {
  CHECK(sent(drive_wheels({.left = -0.2, .right = 0.3})) == CommandBytes{145, 0x01, 0x2C, 0xFF, 0x38});
  CHECK(sent(drive_wheels({.left = 0.7, .right = -0.7})) == CommandBytes{145, 0xFE, 0x0C, 0x01, 0xF4});
}

TEST_CASE("a wheel speed is rounded to whole mm/s", "[hw][create2]") {
  CHECK(sent(drive_wheels({.left = 0.0014, .right = 0.0016})) == CommandBytes{145, 0, 2, 0, 1});
}

TEST_CASE("of the motor voltages the right one is sent first", "[hw][create2]") {
  CHECK(sent(drive_pwm(-1.0, 1.0)) == CommandBytes{146, 0x00, 0xFF, 0xFF, 0x01});
  CHECK(sent(drive_pwm(0.5, -7.0)) == CommandBytes{146, 0xFF, 0x01, 0x00, 0x80});
}

TEST_CASE("what is no number stands still", "[hw][create2]") {
  CHECK(sent(drive(kNoNumber, kInfinite)) == CommandBytes{137, 0, 0, 0x80, 0x00});
  CHECK(sent(drive(0.5, kNoNumber)) == CommandBytes{137, 0, 0, 0, 0});
  CHECK(sent(turn_in_place(kNoNumber)) == CommandBytes{137, 0, 0, 0, 1});
  CHECK(sent(drive_wheels({kNoNumber, kNoNumber})) == CommandBytes{145, 0, 0, 0, 0});
  CHECK(sent(drive_pwm(kNoNumber, kNoNumber)) == CommandBytes{146, 0, 0, 0, 0});
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

TEST_CASE("questions name packets by their numbers", "[hw][create2]") {
  CHECK(sent(ask_packet(kPacketBumpsAndDrops).value()) == CommandBytes{142, 7});
  CHECK(sent(ask_packet(kGroupAll).value()) == CommandBytes{142, 100});
  CHECK(sent(ask_list(CommandBytes{29, 13}).value()) == CommandBytes{149, 2, 29, 13});
}

TEST_CASE("the manual's stream: left cliff signal and virtual wall", "[hw][create2]") {
  CHECK(sent(stream(CommandBytes{29, 13}).value()) == CommandBytes{148, 2, 29, 13});
  CHECK(sent(pause_stream()) == CommandBytes{150, 0});
  CHECK(sent(resume_stream()) == CommandBytes{150, 1});
}

TEST_CASE("packets that do not exist are not asked for", "[hw][create2]") {
  const std::string text = "sensor packet 59 does not exist; packets are 0 to 58, 100, 101, 106 and 107";
  CHECK(refusal(ask_packet(59)) == text);
  CHECK(refusal(ask_list(CommandBytes{7, 59})) == text);
  CHECK(refusal(stream(CommandBytes{59})) == text);
}

TEST_CASE("a stream that the line cannot carry is refused", "[hw][create2]") {
  CHECK(sent(stream(CommandBytes{100, 100, 46, 7, 7}).value()).size() == 7);  // 3 + 81 + 81 + 3 + 2 + 2 = 172
  CHECK(refusal(stream(CommandBytes{100, 100, 46, 46, 7})) ==
        "the sensor packets would make a frame of 173 bytes, but the line carries 172 every 15 ms; ask for "
        "fewer");
  CHECK(refusal(stream(CommandBytes(1000, 7))).find("2003 bytes") != std::string::npos);
  CHECK(stream(CommandBytes(84, 7)).has_value());
}

TEST_CASE("an empty list of packets is refused", "[hw][create2]") {
  CHECK(refusal(stream(CommandBytes{})) == "the list of sensor packets is empty; name at least one");
  CHECK_FALSE(ask_list(CommandBytes{}).has_value());
}
