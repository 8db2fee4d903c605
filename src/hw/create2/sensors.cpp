// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/create2/sensors.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>

namespace orca::hw::create2 {

namespace {

constexpr std::uint8_t kFirstPacket = 7;
constexpr std::uint8_t kLastPacket = 58;

// How a packet is read.
struct Row {
  std::size_t size;  // [bytes]
  bool is_signed;
  void (*set)(Sensors& sensors, int value);
};

constexpr bool has_bit(int value, int bit) { return (value >> bit & 1) != 0; }
constexpr std::uint8_t byte(int value) { return static_cast<std::uint8_t>(value); }
constexpr std::uint16_t word(int value) { return static_cast<std::uint16_t>(value); }
constexpr double milli(int value) { return value / 1000.0; }
constexpr double coulombs(int milliampere_hours) { return 3.6 * milliampere_hours; }
constexpr double radians(int degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double radius(int value) {
  const bool is_straight = value == -32768 || value == 32767;
  return is_straight ? std::numeric_limits<double>::infinity() : milli(value);
}
BumpsAndDrops bumps(int bits) {
  return {has_bit(bits, 1), has_bit(bits, 0), has_bit(bits, 3), has_bit(bits, 2)};
}
Overcurrents overcurrents(int bits) {
  return {has_bit(bits, 4), has_bit(bits, 3), has_bit(bits, 2), has_bit(bits, 0)};
}
void ignore(Sensors& /*sensors*/, int /*value*/) {}

// clang-format off
constexpr std::array<Row, kLastPacket - kFirstPacket + 1> kRows = {{
    {1, false, [](Sensors& s, int v) { s.bumps_and_drops = bumps(v); }},                   // 7
    {1, false, [](Sensors& s, int v) { s.wall = v != 0; }},
    {1, false, [](Sensors& s, int v) { s.cliffs[0] = v != 0; }},
    {1, false, [](Sensors& s, int v) { s.cliffs[1] = v != 0; }},                           // 10
    {1, false, [](Sensors& s, int v) { s.cliffs[2] = v != 0; }},
    {1, false, [](Sensors& s, int v) { s.cliffs[3] = v != 0; }},
    {1, false, [](Sensors& s, int v) { s.virtual_wall = v != 0; }},
    {1, false, [](Sensors& s, int v) { s.overcurrents = overcurrents(v); }},
    {1, false, [](Sensors& s, int v) { s.dirt = byte(v); }},
    {1, false, ignore},
    {1, false, [](Sensors& s, int v) { s.infrared_omni = byte(v); }},
    {1, false, [](Sensors& s, int v) { s.buttons = byte(v); }},
    {2, true, [](Sensors& s, int v) { s.distance = milli(v); }},
    {2, true, [](Sensors& s, int v) { s.angle = radians(v); }},                            // 20
    {1, false, [](Sensors& s, int v) { s.charging_state = static_cast<ChargingState>(v); }},
    {2, false, [](Sensors& s, int v) { s.voltage = milli(v); }},
    {2, true, [](Sensors& s, int v) { s.current = milli(v); }},
    {1, true, [](Sensors& s, int v) { s.temperature = v; }},
    {2, false, [](Sensors& s, int v) { s.charge = coulombs(v); }},
    {2, false, [](Sensors& s, int v) { s.capacity = coulombs(v); }},
    {2, false, [](Sensors& s, int v) { s.wall_signal = word(v); }},
    {2, false, [](Sensors& s, int v) { s.cliff_signals[0] = word(v); }},
    {2, false, [](Sensors& s, int v) { s.cliff_signals[1] = word(v); }},
    {2, false, [](Sensors& s, int v) { s.cliff_signals[2] = word(v); }},                   // 30
    {2, false, [](Sensors& s, int v) { s.cliff_signals[3] = word(v); }},
    {1, false, ignore},
    {2, false, ignore},
    {1, false, [](Sensors& s, int v) { s.charging_sources = {has_bit(v, 0), has_bit(v, 1)}; }},
    {1, false, [](Sensors& s, int v) { s.mode = static_cast<Mode>(v); }},
    {1, false, [](Sensors& s, int v) { s.song = byte(v); }},
    {1, false, [](Sensors& s, int v) { s.song_playing = v != 0; }},
    {1, false, [](Sensors& s, int v) { s.stream_packets = byte(v); }},
    {2, true, [](Sensors& s, int v) { s.requested_speed = milli(v); }},
    {2, true, [](Sensors& s, int v) { s.requested_radius = radius(v); }},                  // 40
    {2, true, [](Sensors& s, int v) { s.requested_right = milli(v); }},
    {2, true, [](Sensors& s, int v) { s.requested_left = milli(v); }},
    {2, false, [](Sensors& s, int v) { s.left_counts = word(v); }},
    {2, false, [](Sensors& s, int v) { s.right_counts = word(v); }},
    {1, false, [](Sensors& s, int v) { s.light_bumper = byte(v); }},
    {2, false, [](Sensors& s, int v) { s.light_signals[0] = word(v); }},
    {2, false, [](Sensors& s, int v) { s.light_signals[1] = word(v); }},
    {2, false, [](Sensors& s, int v) { s.light_signals[2] = word(v); }},
    {2, false, [](Sensors& s, int v) { s.light_signals[3] = word(v); }},
    {2, false, [](Sensors& s, int v) { s.light_signals[4] = word(v); }},                   // 50
    {2, false, [](Sensors& s, int v) { s.light_signals[5] = word(v); }},
    {1, false, [](Sensors& s, int v) { s.infrared_left = byte(v); }},
    {1, false, [](Sensors& s, int v) { s.infrared_right = byte(v); }},
    {2, true, [](Sensors& s, int v) { s.left_motor_current = milli(v); }},
    {2, true, [](Sensors& s, int v) { s.right_motor_current = milli(v); }},
    {2, true, [](Sensors& s, int v) { s.main_brush_current = milli(v); }},
    {2, true, [](Sensors& s, int v) { s.side_brush_current = milli(v); }},
    {1, false, [](Sensors& s, int v) { s.stasis = {has_bit(v, 0), has_bit(v, 1)}; }},      // 58
}};
// clang-format on

struct Range {
  std::uint8_t number;
  std::uint8_t first;
  std::uint8_t last;
};

constexpr std::array<Range, 11> kGroups = {{{kGroup0, 7, 26},
                                            {kGroup1, 7, 16},
                                            {kGroup2, 17, 20},
                                            {kGroup3, 21, 26},
                                            {kGroup4, 27, 34},
                                            {kGroup5, 35, 42},
                                            {kGroup6, 7, 42},
                                            {kGroupAll, 7, 58},
                                            {kGroupNew, 43, 58},
                                            {kGroupLight, 46, 51},
                                            {kGroupCurrents, 54, 58}}};

// The packets that one or a group consists of; none if there is no such packet.
std::span<const Row> rows_of(std::uint8_t packet) {
  if (packet >= kFirstPacket && packet <= kLastPacket) return {&kRows[packet - kFirstPacket], 1};
  const auto group = std::ranges::find(kGroups, packet, &Range::number);
  if (group == kGroups.end()) return {};
  return std::span(kRows).subspan(group->first - kFirstPacket, group->last - group->first + 1U);
}

int number_of(const Row& row, std::span<const std::uint8_t> data) {
  const int raw = row.size == 1 ? data[0] : 256 * data[0] + data[1];
  if (!row.is_signed) return raw;
  return row.size == 1 ? static_cast<std::int8_t>(raw) : static_cast<std::int16_t>(raw);
}

Error unknown_packet(std::uint8_t packet) {
  return fail(Code::invalid_argument, "sensor packet " + std::to_string(packet) + " does not exist");
}

Error wrong_size(const std::string& of, std::size_t expected, std::size_t found) {
  return fail(Code::data_loss, of + ": " + std::to_string(expected) + " bytes expected, " +
                                   std::to_string(found) + " found; ask again");
}

}  // namespace

std::optional<std::size_t> data_size(std::uint8_t packet) {
  const auto rows = rows_of(packet);
  if (rows.empty()) return std::nullopt;
  std::size_t size = 0;
  for (const Row& row : rows) size += row.size;
  return size;
}

Status Sensors::apply(std::uint8_t packet, std::span<const std::uint8_t> data) {
  const auto size = data_size(packet);
  if (!size) return unknown_packet(packet);
  if (*size != data.size()) return wrong_size("sensor packet " + std::to_string(packet), *size, data.size());
  for (const Row& row : rows_of(packet)) {
    row.set(*this, number_of(row, data));
    data = data.subspan(row.size);
  }
  return ok();
}

Status Sensors::apply_list(std::span<const std::uint8_t> packets, std::span<const std::uint8_t> data) {
  std::size_t expected = 0;
  for (const std::uint8_t packet : packets) {
    const auto size = data_size(packet);
    if (!size) return unknown_packet(packet);
    expected += *size;
  }
  if (expected != data.size()) return wrong_size("answer to a list of packets", expected, data.size());
  for (const std::uint8_t packet : packets) {
    const std::size_t size = *data_size(packet);
    if (auto applied = apply(packet, data.first(size)); !applied) return applied;
    data = data.subspan(size);
  }
  return ok();
}

Status Sensors::apply_body(std::span<const std::uint8_t> body) {
  Sensors changed = *this;
  while (!body.empty()) {
    const std::uint8_t packet = body[0];
    const auto size = data_size(packet);
    if (!size) return unknown_packet(packet);
    const auto data = body.subspan(1, std::min(*size, body.size() - 1));
    if (auto applied = changed.apply(packet, data); !applied) return applied;
    body = body.subspan(1 + data.size());
  }
  *this = changed;
  return ok();
}

std::optional<double> state_of_charge(const Sensors& sensors) {
  if (!sensors.charge || !sensors.capacity || *sensors.capacity <= 0.0) return std::nullopt;
  return std::clamp(*sensors.charge / *sensors.capacity, 0.0, 1.0);
}

}  // namespace orca::hw::create2
