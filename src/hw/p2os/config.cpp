// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/config.hpp"

#include <numbers>

#include "orca/hw/framing/byte_reader.hpp"
#include "orca/hw/p2os/packet.hpp"

namespace orca::hw::p2os {
namespace {

using framing::ByteReader;

constexpr std::uint8_t kResetsBaud = 2;

double millimetres(ByteReader& reader) { return reader.u16() * 0.001; }
double degrees(ByteReader& reader) { return reader.u16() * (std::numbers::pi / 180.0); }
Duration milliseconds(std::uint16_t count) { return std::chrono::milliseconds(count); }

Gains read_gains(ByteReader& reader) {
  Gains gains;
  gains.proportional = reader.u16();
  gains.derivative = reader.u16();
  gains.integral = reader.u16();
  return gains;
}

// The fields come in the order of the packet, which mixes subjects; so do these functions.
void read_hardware(Config& config, ByteReader& reader) {
  config.robot_class = reader.text_to_zero();
  config.subclass = reader.text_to_zero();
  config.serial_number = reader.text_to_zero();
  reader.u8();  // not used any more
  config.turn_rate.top_rate = degrees(reader);
  config.speed.top_rate = millimetres(reader);
  config.turn_rate.top_acceleration = degrees(reader);
  config.speed.top_acceleration = millimetres(reader);
  config.max_pwm = reader.u16();
}

void read_accessories(Config& config, ByteReader& reader) {
  config.name = reader.text_to_zero();
  config.sip_cycle = milliseconds(reader.u8());
  config.host_baud = reader.u8();
  config.aux1_baud = reader.u8();
  config.gripper = reader.u16();
  config.has_front_sonar = reader.u16() != 0;
  config.has_rear_sonar = reader.u8() != 0;
  config.low_battery_voltage = reader.u16() * 0.1;
  config.counts_per_turn = reader.u16();
  config.watchdog = milliseconds(reader.u16());
  config.sends_two_sips = reader.u8() != 0;
  config.stall_value = reader.u16();
  config.stall_count = reader.u16();
}

void read_motion(Config& config, ByteReader& reader) {
  config.joystick_speed = millimetres(reader);
  config.joystick_turn_rate = degrees(reader);
  config.turn_rate.max_rate = degrees(reader);
  config.speed.max_rate = millimetres(reader);
  config.turn_rate.acceleration = degrees(reader);
  config.turn_rate.deceleration = degrees(reader);
  config.turn_rate_gains = read_gains(reader);
  config.speed.acceleration = millimetres(reader);
  config.speed.deceleration = millimetres(reader);
  config.speed_gains = read_gains(reader);
}

void read_newer_fields(Config& config, ByteReader& reader) {
  config.front_bumpers = reader.u8();
  config.rear_bumpers = reader.u8();
  config.charger = reader.u8();
  config.sonar_cycle = milliseconds(reader.u8());
  config.resets_baud = reader.u8() == kResetsBaud;
  config.gyro_type = reader.u8();
  config.drift_factor = reader.s16();
  config.aux2_baud = reader.u8();
  config.aux3_baud = reader.u8();
  config.counts_per_millimetre = reader.u16();
  config.shutdown_voltage = reader.u16();
  config.firmware_version = reader.text_to_zero();
}

}  // namespace

std::optional<Config> parse_config(std::span<const std::uint8_t> body) {
  if (body.empty() || body[0] != static_cast<std::uint8_t>(PacketType::config)) return std::nullopt;
  ByteReader reader(body.subspan(1));
  Config config;
  read_hardware(config, reader);
  read_accessories(config, reader);
  read_motion(config, reader);
  read_newer_fields(config, reader);
  return config;
}

}  // namespace orca::hw::p2os
