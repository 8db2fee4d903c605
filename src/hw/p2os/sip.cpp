// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/sip.hpp"

#include <string>

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::p2os {
namespace {

using framing::ByteReader;

constexpr std::uint8_t kFirstType = 0x30;
constexpr std::uint8_t kLastType = 0x34;
constexpr std::uint8_t kMoving = 0x33;
constexpr std::size_t kFixedSize = 20;  // up to the number of echoes
constexpr std::size_t kEchoSize = 3;
constexpr std::size_t kPortsSize = 5;
constexpr double kDecivolt = 0.1;
constexpr double kDegreeInRad = std::numbers::pi / 180.0;
constexpr double kAnalogStep = 5.0 / 255.0;  // [V]

void read_wheels(Sip& sip, ByteReader& reader, const Model& model) {
  sip.x = reader.u16() & 0x7FFF;
  sip.y = reader.u16() & 0x7FFF;
  sip.heading = reader.s16() * model.angle_unit;
  sip.left_speed = reader.s16() * model.velocity_unit;
  sip.right_speed = reader.s16() * model.velocity_unit;
}

void read_state(Sip& sip, ByteReader& reader, const Model& model) {
  sip.battery_voltage = reader.u8() * kDecivolt;
  const unsigned left_and_rear = reader.u8();
  const unsigned right_and_front = reader.u8();
  sip.left_stall = (left_and_rear & 1U) != 0;
  sip.right_stall = (right_and_front & 1U) != 0;
  sip.rear_bumpers = static_cast<std::uint8_t>(left_and_rear >> 1);
  sip.front_bumpers = static_cast<std::uint8_t>(right_and_front >> 1);
  sip.control_heading = reader.s16() * model.angle_unit;
  const unsigned flags = reader.u16();
  sip.motors_enabled = (flags & 1U) != 0;
  sip.sonar_groups = static_cast<std::uint8_t>((flags >> 1) & 0xFU);
  sip.emergency_stop = (flags & 0x20U) != 0;
  // 0 and 255 stand for no compass; a full turn is 180 steps.
  const unsigned compass = reader.u8();
  if (compass >= 1 && compass <= 180) sip.compass = 2 * compass * kDegreeInRad;
}

PortState read_ports(ByteReader& reader) {
  PortState ports;
  ports.analog_port = reader.u8();
  ports.gripper = reader.u8();
  ports.analog_voltage = reader.u8() * kAnalogStep;
  ports.digital_in = reader.u8();
  ports.digital_out = reader.u8();
  return ports;
}

SipTail read_tail(ByteReader& reader) {
  SipTail tail;
  const auto has = [&](std::size_t size) { return reader.remaining() >= size; };
  if (has(2)) tail.real_battery_voltage = reader.u16() * kDecivolt;
  if (has(1)) tail.charge_state = reader.u8();
  if (has(2)) tail.turn_rate = reader.s16() * 0.1 * kDegreeInRad;
  if (has(2)) tail.fault_flags = reader.u16();
  if (has(2)) tail.left_velocity = reader.s16() * 0.001;
  if (has(1)) tail.temperature = reader.s8();
  if (has(1)) tail.state_of_charge = reader.u8();
  if (has(4)) tail.microseconds = reader.u32();
  if (has(4)) tail.flags = reader.u32();
  return tail;
}

Error too_short(std::size_t size, std::size_t needed) {
  return fail(Code::data_loss, "a SIP of " + std::to_string(size) + " bytes, which should have at least " +
                                   std::to_string(needed) + "; it is not used");
}

}  // namespace

bool is_sip(std::span<const std::uint8_t> body) {
  return !body.empty() && body[0] >= kFirstType && body[0] <= kLastType;
}

Result<Sip> parse_sip(std::span<const std::uint8_t> body, const Model& model) {
  if (!is_sip(body)) return fail(Code::invalid_argument, "not a SIP: its type is none of 30 to 34 (hex)");
  if (body.size() < kFixedSize) return too_short(body.size(), kFixedSize);
  ByteReader reader(body);
  Sip sip;
  sip.type = reader.u8();
  sip.is_moving = sip.type == kMoving;
  read_wheels(sip, reader, model);
  read_state(sip, reader, model);
  const std::size_t echoes = reader.u8();
  if (reader.remaining() < kEchoSize * echoes) return too_short(body.size(), kFixedSize + kEchoSize * echoes);
  for (std::size_t i = 0; i < echoes; ++i) {
    const std::uint8_t index = reader.u8();
    sip.echoes.push_back({index, reader.u16() * model.range_unit});
  }
  if (reader.remaining() < kPortsSize) return sip;
  sip.ports = read_ports(reader);
  sip.tail = read_tail(reader);
  return sip;
}

}  // namespace orca::hw::p2os
