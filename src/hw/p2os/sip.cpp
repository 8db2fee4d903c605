// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/sip.hpp"

#include <string>

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::p2os {
namespace {

using framing::ByteReader;

constexpr std::uint8_t kFirstType = 0x30;
constexpr std::uint8_t kLastType = 0x34;
constexpr std::size_t kFixedSize = 20;  // up to the number of echoes
constexpr std::size_t kEchoSize = 3;
constexpr std::size_t kPortsSize = 5;
constexpr double kDecivolt = 0.1;

void read_wheels(Sip& sip, ByteReader& reader, const Model& model) {
  sip.x = reader.u16() & 0x7FFF;
  sip.y = reader.u16() & 0x7FFF;
  sip.heading = reader.s16() * model.angle_unit;
  sip.left_speed = reader.s16() * model.velocity_unit;
  sip.right_speed = reader.s16() * model.velocity_unit;
}

void read_state(Sip& sip, ByteReader& reader) {
  sip.battery_voltage = reader.u8() * kDecivolt;
  const unsigned left_and_rear = reader.u8();
  const unsigned right_and_front = reader.u8();
  sip.left_stall = (left_and_rear & 1U) != 0;
  sip.right_stall = (right_and_front & 1U) != 0;
  sip.rear_bumpers = static_cast<std::uint8_t>(left_and_rear >> 1);
  sip.front_bumpers = static_cast<std::uint8_t>(right_and_front >> 1);
  reader.bytes(2);  // the heading that the robot turns to
  const unsigned flags = reader.u16();
  sip.motors_enabled = (flags & 1U) != 0;
  sip.sonar_groups = static_cast<std::uint8_t>((flags >> 1) & 0xFU);
  sip.emergency_stop = (flags & 0x20U) != 0;
  reader.bytes(1);  // compass
}

PortState read_ports(ByteReader& reader) {
  PortState ports;
  reader.bytes(1);  // the analog port whose voltage it tells
  ports.gripper = reader.u8();
  reader.bytes(1);  // that voltage
  ports.digital_in = reader.u8();
  reader.bytes(1);  // digital outputs
  return ports;
}

std::optional<double> temperature_of(std::uint8_t byte) {
  constexpr int kNoSensor = -128;
  const int degrees = static_cast<std::int8_t>(byte);
  return degrees == kNoSensor ? std::nullopt : std::optional<double>(degrees);
}

SipTail read_tail(ByteReader& reader) {
  SipTail tail;
  const auto has = [&](std::size_t size) { return reader.remaining() >= size; };
  if (has(2)) tail.real_battery_voltage = reader.u16() * kDecivolt;
  if (has(1)) tail.charge_state = reader.u8();
  reader.bytes(6);  // turn rate, faults, sideways speed
  if (has(1)) tail.temperature = temperature_of(reader.u8());
  if (has(1)) tail.state_of_charge = reader.u8();
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
  reader.bytes(1);  // its type
  read_wheels(sip, reader, model);
  read_state(sip, reader);
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
