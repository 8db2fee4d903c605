// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/create2/sensors.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace orca::hw::create2;
using SensorBytes = std::vector<std::uint8_t>;

namespace {

Sensors after(std::uint8_t packet, const SensorBytes& data) {
  Sensors sensors;
  REQUIRE(sensors.apply(packet, data).ok());
  return sensors;
}

// Number 1 for the first byte, 2 for the second, and so on.
SensorBytes counting(std::size_t size) {
  SensorBytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i + 1);
  return bytes;
}

}  // namespace

TEST_CASE("groups have the sizes of the manual", "[hw][create2]") {
  CHECK(data_size(kGroup0) == 26);
  CHECK(data_size(kGroup1) == 10);
  CHECK(data_size(kGroup2) == 6);
  CHECK(data_size(kGroup3) == 10);
  CHECK(data_size(kGroup4) == 14);
  CHECK(data_size(kGroup5) == 12);
  CHECK(data_size(kGroup6) == 52);
  CHECK(data_size(kGroupAll) == 80);
  CHECK(data_size(kGroupNew) == 28);
  CHECK(data_size(kGroupLight) == 12);
  CHECK(data_size(kGroupCurrents) == 9);
}

TEST_CASE("packets are 7 to 58", "[hw][create2]") {
  CHECK(data_size(7) == 1);
  CHECK(data_size(19) == 2);
  CHECK(data_size(24) == 1);
  CHECK(data_size(32) == 1);
  CHECK(data_size(33) == 2);
  CHECK(data_size(45) == 1);
  CHECK(data_size(58) == 1);
  for (const int none : {59, 60, 99, 102, 105, 108, 255})
    CHECK_FALSE(data_size(static_cast<std::uint8_t>(none)).has_value());
}

TEST_CASE("bumps and wheel drops are bits", "[hw][create2]") {
  CHECK(after(7, {0x01}).bumps_and_drops == BumpsAndDrops{.bump_right = true});
  CHECK(after(7, {0x02}).bumps_and_drops == BumpsAndDrops{.bump_left = true});
  CHECK(after(7, {0x04}).bumps_and_drops == BumpsAndDrops{.drop_right = true});
  CHECK(after(7, {0x08}).bumps_and_drops == BumpsAndDrops{.drop_left = true});
}

TEST_CASE("overcurrents are bits", "[hw][create2]") {
  CHECK(after(14, {0x01}).overcurrents == Overcurrents{.side_brush = true});
  CHECK(after(14, {0x04}).overcurrents == Overcurrents{.main_brush = true});
  CHECK(after(14, {0x08}).overcurrents == Overcurrents{.right_wheel = true});
  CHECK(after(14, {0x10}).overcurrents == Overcurrents{.left_wheel = true});
}

TEST_CASE("cliffs are counted from the left", "[hw][create2]") {
  const Sensors sensors = after(kGroup1, {0, 1, 1, 0, 0, 1, 0, 0, 0, 0});
  CHECK(sensors.wall == true);
  CHECK(sensors.cliffs == std::array<std::optional<bool>, 4>{true, false, false, true});
  CHECK(sensors.virtual_wall == false);
}

TEST_CASE("the battery is reported in SI units", "[hw][create2]") {
  const Sensors sensors = after(kGroup3, {2, 0x3D, 0x86, 0xFF, 0x06, 0xFB, 0x05, 0xDC, 0x0B, 0xB8});
  CHECK(sensors.charging_state == ChargingState::full);
  CHECK(*sensors.voltage == Approx(15.75));
  CHECK(*sensors.current == Approx(-0.25));
  CHECK(*sensors.temperature == -5.0);
  CHECK(*sensors.charge == Approx(5400.0));  // 1500 mAh
  CHECK(*sensors.capacity == Approx(10800.0));
  CHECK(*state_of_charge(sensors) == Approx(0.5));
}

TEST_CASE("the state of charge is not known without a capacity, and at most 1", "[hw][create2]") {
  CHECK_FALSE(state_of_charge(Sensors{}).has_value());
  CHECK_FALSE(state_of_charge(Sensors{.charge = 1.0, .capacity = 0.0}).has_value());
  CHECK_FALSE(state_of_charge(Sensors{.charge = 1.0}).has_value());
  CHECK(state_of_charge(Sensors{.charge = 2.0, .capacity = 1.0}) == 1.0);
}

TEST_CASE("chargers and the mode", "[hw][create2]") {
  CHECK(after(34, {1}).charging_sources == ChargingSources{.internal = true});
  CHECK(after(34, {2}).charging_sources == ChargingSources{.home_base = true});
  CHECK(after(35, {3}).mode == Mode::full);
}

TEST_CASE("distance and angle are signed", "[hw][create2]") {
  const Sensors sensors = after(kGroup2, {0xA1, 0x05, 0xFF, 0x38, 0xFF, 0xA6});
  CHECK(sensors.infrared_omni == 0xA1);
  CHECK(sensors.buttons == 0x05);
  CHECK(*sensors.distance == Approx(-0.2));
  CHECK(*sensors.angle == Approx(-std::numbers::pi / 2.0));
}

TEST_CASE("what was requested of the motors", "[hw][create2]") {
  const Sensors sensors = after(kGroup5, {2, 3, 1, 4, 0xFF, 0x38, 0x01, 0xF4, 0x00, 0x64, 0xFF, 0x9C});
  CHECK(sensors.mode == Mode::safe);
  CHECK(sensors.song == 3);
  CHECK(sensors.song_playing == true);
  CHECK(sensors.stream_packets == 4);
  CHECK(*sensors.requested_speed == Approx(-0.2));
  CHECK(*sensors.requested_radius == Approx(0.5));
  CHECK(*sensors.requested_right == Approx(0.1));
  CHECK(*sensors.requested_left == Approx(-0.1));
  CHECK(std::isinf(*after(40, {0x80, 0x00}).requested_radius));
  CHECK(std::isinf(*after(40, {0x7F, 0xFF}).requested_radius));
}

TEST_CASE("all packets are read from the largest group, each from its place", "[hw][create2]") {
  const Sensors sensors = after(kGroupAll, counting(80));
  CHECK(sensors.bumps_and_drops == BumpsAndDrops{.bump_right = true});
  CHECK(sensors.dirt == 9);
  CHECK(sensors.infrared_omni == 11);
  CHECK(*sensors.capacity == Approx(3.6 * (256 * 25 + 26)));
  CHECK(sensors.wall_signal == 256 * 27 + 28);
  CHECK(sensors.cliff_signals[0] == 256 * 29 + 30);
  CHECK(sensors.cliff_signals[3] == 256 * 35 + 36);
  CHECK(sensors.charging_sources == ChargingSources{});  // byte 40
  CHECK(*sensors.requested_left == Approx(0.001 * (256 * 51 + 52)));
  CHECK(sensors.left_counts == 256 * 53 + 54);
  CHECK(sensors.right_counts == 256 * 55 + 56);
  CHECK(sensors.light_bumper == 57);
  CHECK(sensors.light_signals[0] == 256 * 58 + 59);
  CHECK(sensors.light_signals[5] == 256 * 68 + 69);
  CHECK(sensors.infrared_left == 70);
  CHECK(sensors.infrared_right == 71);
  CHECK(*sensors.left_motor_current == Approx(0.001 * (256 * 72 + 73)));
  CHECK(*sensors.right_motor_current == Approx(0.001 * (256 * 74 + 75)));
  CHECK(*sensors.main_brush_current == Approx(0.001 * (256 * 76 + 77)));
  CHECK(*sensors.side_brush_current == Approx(0.001 * (256 * 78 + 79)));
  CHECK(sensors.stasis == Stasis{});  // byte 80: 0101 0000
}

TEST_CASE("a group is read as its packets are", "[hw][create2]") {
  const SensorBytes all = counting(80);
  Sensors one_by_one;
  std::size_t at = 0;
  for (std::uint8_t packet = 7; packet <= 58; ++packet) {
    const std::size_t size = data_size(packet).value();
    REQUIRE(one_by_one.apply(packet, std::span(all).subspan(at, size)).ok());
    at += size;
  }
  CHECK(one_by_one == after(kGroupAll, all));
}

TEST_CASE("motor currents are signed, and stasis has two bits", "[hw][create2]") {
  const Sensors sensors = after(kGroupCurrents, {0xFF, 0x9C, 0, 0, 0, 0, 0, 0, 0x02});
  CHECK(*sensors.left_motor_current == Approx(-0.1));
  CHECK(sensors.stasis == Stasis{.disabled = true});
  CHECK(after(58, {1}).stasis == Stasis{.toggling = true});
}

TEST_CASE("the answer to a list is the data alone", "[hw][create2]") {
  Sensors sensors;
  CHECK(sensors.apply_list(SensorBytes{29, 13}, SensorBytes{2, 25, 1}).ok());
  CHECK(sensors.cliff_signals[1] == 537);
  CHECK(sensors.virtual_wall == true);
}

TEST_CASE("data of a wrong size change nothing", "[hw][create2]") {
  Sensors sensors;
  const auto short_data = sensors.apply(22, SensorBytes{1});
  REQUIRE_FALSE(short_data.ok());
  CHECK(short_data.error().text() == "sensor packet 22: 2 bytes expected, 1 found; ask again");
  CHECK_FALSE(sensors.apply(kGroupAll, SensorBytes(81)).ok());
  CHECK_FALSE(sensors.apply(59, SensorBytes{}).ok());
  const auto short_list = sensors.apply_list(SensorBytes{29, 13}, SensorBytes{2, 25});
  REQUIRE_FALSE(short_list.ok());
  CHECK(short_list.error().text() == "answer to a list of packets: 3 bytes expected, 2 found; ask again");
  CHECK_FALSE(sensors.apply_list(SensorBytes{59}, SensorBytes{2}).ok());
  CHECK_FALSE(sensors.apply_body(SensorBytes{29, 2, 25, 13}).ok());
  CHECK_FALSE(sensors.apply_body(SensorBytes{29, 2, 25, 59, 0}).ok());
  CHECK(sensors == Sensors{});
}
