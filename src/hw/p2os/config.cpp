// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/config.hpp"

#include <numbers>

#include "orca/hw/framing/byte_reader.hpp"
#include "orca/hw/p2os/packet.hpp"

namespace orca::hw::p2os {
namespace {

constexpr std::uint8_t kResetsBaud = 2;

}  // namespace

// The fields come in the order of the packet, which mixes subjects.
std::optional<Config> parse_config(std::span<const std::uint8_t> body) {
  if (body.empty() || body[0] != static_cast<std::uint8_t>(PacketType::config)) return std::nullopt;
  framing::ByteReader reader(body.subspan(1));
  const auto skip_texts = [&](int count) {
    while (count-- > 0) (void)reader.text_to_zero();
  };
  Config config;
  skip_texts(3);    // class, subclass, serial number
  reader.bytes(1);  // not used any more
  config.top_turn_rate = reader.u16() * (std::numbers::pi / 180.0);
  config.top_speed = reader.u16() * 0.001;
  reader.bytes(6);  // accelerations, power limit of the motors
  skip_texts(1);    // name
  reader.bytes(8);  // cycle of the SIPs, rates of the lines, gripper, sonars
  config.low_battery_voltage = reader.u16() * 0.1;
  reader.bytes(2);  // encoder counts of half a turn
  config.watchdog = std::chrono::milliseconds(reader.u16());
  reader.bytes(33);  // stalls, joystick, limits and gains of driving and turning
  reader.bytes(4);   // bumpers, charger, cycle of the sonars
  config.resets_baud = reader.u8() == kResetsBaud;
  return config;
}

}  // namespace orca::hw::p2os
