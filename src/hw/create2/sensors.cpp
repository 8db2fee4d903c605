// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/create2/sensors.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "orca/hw/create2/command.hpp"
#include "orca/hw/framing/checksums.hpp"

namespace orca::hw::create2 {
namespace {

// How a packet is read.
struct Row {
  Packet packet;
  std::size_t size;  // [bytes]
  void (*set)(Sensors& sensors, int value);
};

constexpr bool has_bit(int value, int bit) { return (value >> bit & 1) != 0; }
constexpr std::uint16_t word(int value) { return static_cast<std::uint16_t>(value); }
constexpr double coulombs(int milliampere_hours) { return 3.6 * milliampere_hours; }

BumpsAndDrops bumps(int bits) {
  return {has_bit(bits, 1), has_bit(bits, 0), has_bit(bits, 3), has_bit(bits, 2)};
}

constexpr std::array<Row, 14> kRows = {{
    {Packet::bumps_and_drops, 1, [](Sensors& s, int v) { s.bumps_and_drops = bumps(v); }},
    {Packet::cliff_left, 1, [](Sensors& s, int v) { s.cliffs[0] = v != 0; }},
    {Packet::cliff_front_left, 1, [](Sensors& s, int v) { s.cliffs[1] = v != 0; }},
    {Packet::cliff_front_right, 1, [](Sensors& s, int v) { s.cliffs[2] = v != 0; }},
    {Packet::cliff_right, 1, [](Sensors& s, int v) { s.cliffs[3] = v != 0; }},
    {Packet::overcurrents, 1, [](Sensors& s, int v) { s.is_stalled = has_bit(v, 3) || has_bit(v, 4); }},
    {Packet::charging_state, 1, [](Sensors& s, int v) { s.charging_state = static_cast<ChargingState>(v); }},
    {Packet::voltage, 2, [](Sensors& s, int v) { s.voltage = v / 1000.0; }},
    {Packet::charge, 2, [](Sensors& s, int v) { s.charge = coulombs(v); }},
    {Packet::capacity, 2, [](Sensors& s, int v) { s.capacity = coulombs(v); }},
    {Packet::charging_sources, 1,
     [](Sensors& s, int v) { s.is_at_charger = has_bit(v, 0) || has_bit(v, 1); }},
    {Packet::mode, 1, [](Sensors& s, int v) { s.mode = static_cast<Mode>(v); }},
    {Packet::left_counts, 2, [](Sensors& s, int v) { s.left_counts = word(v); }},
    {Packet::right_counts, 2, [](Sensors& s, int v) { s.right_counts = word(v); }},
}};

const Row* row_of(std::uint8_t packet) {
  const auto row = std::ranges::find(kRows, static_cast<Packet>(packet), &Row::packet);
  return row == kRows.end() ? nullptr : &*row;
}

constexpr std::uint8_t kHeader = 19;

// Whether packets, the first of which begin with these bytes, can fit exactly into a body of that length.
bool can_fit(std::span<const std::uint8_t> bytes, std::size_t length) {
  std::size_t at = 0;
  while (at < bytes.size()) {
    const auto size = data_size(bytes[at]);
    if (!size) return false;
    at += 1 + *size;
  }
  return length > 0 && at <= length;
}

}  // namespace

std::optional<std::size_t> data_size(std::uint8_t packet) {
  const Row* const row = row_of(packet);
  return row != nullptr ? std::optional(row->size) : std::nullopt;
}

std::optional<Sensors> parse_body(std::span<const std::uint8_t> body) {
  Sensors sensors;
  while (!body.empty()) {
    const Row* const row = row_of(body[0]);
    if (row == nullptr || body.size() < 1 + row->size) return std::nullopt;
    row->set(sensors, row->size == 1 ? body[1] : 256 * body[1] + body[2]);
    body = body.subspan(1 + row->size);
  }
  return sensors;
}

std::optional<double> state_of_charge(const Sensors& sensors) {
  if (!sensors.charge || !sensors.capacity || *sensors.capacity <= 0.0) return std::nullopt;
  return std::clamp(*sensors.charge / *sensors.capacity, 0.0, 1.0);
}

framing::Finding look(std::span<const std::uint8_t> bytes) {
  using Kind = framing::Finding::Kind;
  if (bytes[0] != kHeader) return {};
  if (bytes.size() < 2) return {Kind::need_more};
  const std::size_t length = bytes[1];
  if (!can_fit(bytes.subspan(2, std::min(length, bytes.size() - 2)), length)) return {};
  if (bytes.size() < length + 3) return {Kind::need_more};
  if (framing::sum_of_bytes(bytes.first(length + 3)) != 0) return {Kind::bad_checksum};
  return {Kind::frame, length + 3};
}

std::span<const std::uint8_t> body_of(std::span<const std::uint8_t> frame) {
  return frame.subspan(2, frame.size() - 3);
}

int step_of(std::uint16_t previous, std::uint16_t next) {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(next - previous));
}

double wheel_way(int counts) { return counts * (std::numbers::pi * kWheelDiameter / kCountsPerTurn); }

Travel2 EncoderOdometry::add(std::uint16_t left, std::uint16_t right) {
  const auto previous = std::exchange(previous_, Counts{left, right});
  if (!previous) return {};
  const double left_way = wheel_way(step_of(previous->left, left));
  const double right_way = wheel_way(step_of(previous->right, right));
  return {.forward = (left_way + right_way) / 2.0, .turn = (right_way - left_way) / kWheelBase};
}

}  // namespace orca::hw::create2
