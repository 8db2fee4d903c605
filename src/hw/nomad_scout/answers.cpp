// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/nomad_scout/answers.hpp"

#include "fields.hpp"

namespace orca::hw::nomad_scout {
namespace {

bool is_answer(const Message& message, Type type, std::size_t size) {
  return message.type == type && message.payload.size() >= size;
}

}  // namespace

std::optional<SonarAnswer> parse_sonars(const Message& message) {
  if (!is_answer(message, Type::get_sonars, 20)) return std::nullopt;
  framing::ByteReader reader(message.payload);
  SonarAnswer answer;
  answer.sonars = read_sonars(reader);
  answer.controller_time = read_time(reader);
  return answer;
}

std::optional<PositionAnswer> parse_position(const Message& message) {
  if (!is_answer(message, Type::get_position, 8)) return std::nullopt;
  framing::ByteReader reader(message.payload);
  PositionAnswer answer;
  answer.position = read_position(reader);
  answer.heading = read_angle(reader);
  answer.turret = read_angle(reader);
  return answer;
}

std::optional<Wheels> parse_velocities(const Message& message) {
  if (!is_answer(message, Type::get_velocities, 6)) return std::nullopt;
  framing::ByteReader reader(message.payload);
  return read_speeds(reader);
}

std::optional<BumperAnswer> parse_bumpers(const Message& message) {
  if (!is_answer(message, Type::get_bumpers, 7)) return std::nullopt;
  framing::ByteReader reader(message.payload);
  BumperAnswer answer;
  answer.bumpers = read_bumpers(reader);
  answer.controller_time = read_time(reader);
  return answer;
}

std::optional<std::span<const std::uint8_t>> parse_special(const Message& message) {
  if (!is_answer(message, Type::special, 2)) return std::nullopt;
  framing::ByteReader reader(message.payload);
  const std::size_t size = reader.u16();
  if (reader.remaining() < size) return std::nullopt;
  return reader.bytes(size);
}

}  // namespace orca::hw::nomad_scout
