// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/nomad_scout/state.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include "orca/hw/framing/byte_reader.hpp"
#include "orca/hw/nomad_scout/base.hpp"

namespace orca::hw::nomad_scout {
namespace {

constexpr std::size_t kStateSize = 42;
constexpr double kMotorScale = 12.85;  // [V]

double voltage(std::uint8_t raw, double scale) { return (2.0 + 3.0 * raw / 255.0) * scale / 5.0; }

int read_signed(framing::ByteReader& reader) { return from_sign_and_magnitude(reader.u16()); }

double read_angle(framing::ByteReader& reader) { return wrapped(radians(read_signed(reader))); }

SonarRanges read_sonars(framing::ByteReader& reader) {
  constexpr std::uint8_t kNoEcho = 255;
  constexpr double kInch = 0.0254;
  SonarRanges ranges;
  for (double& range : ranges) {
    const std::uint8_t inches = reader.u8();
    range = inches == kNoEcho ? std::numeric_limits<double>::infinity() : inches * kInch;
  }
  return ranges;
}

// A Scout sends the low byte first; the larger Nomads do not.
std::uint32_t read_bumpers(framing::ByteReader& reader) {
  const std::uint32_t low = reader.u16();
  return low + (std::uint32_t{reader.u8()} << 16);
}

RawPosition read_position(framing::ByteReader& reader) {
  const int x = read_signed(reader);
  return {x, read_signed(reader)};
}

// Right wheel, left wheel, turret.
Wheels read_speeds(framing::ByteReader& reader) {
  const double right = read_signed(reader) * kLengthUnit;
  const double left = read_signed(reader) * kLengthUnit;
  reader.u16();
  return {.left = left, .right = right};
}

Duration read_time(framing::ByteReader& reader) { return std::chrono::milliseconds(reader.u32()); }

State read_state(std::span<const std::uint8_t> payload) {
  framing::ByteReader reader(payload);
  State state;
  state.sonars = read_sonars(reader);
  state.bumpers = read_bumpers(reader);
  state.position = read_position(reader);
  state.heading = read_angle(reader);
  reader.u16();  // turret
  state.speeds = read_speeds(reader);
  reader.bytes(3);  // compass, which motors turn
  state.controller_time = read_time(reader);
  reader.u8();  // battery of the computer
  state.motor_voltage = voltage(reader.u8(), kMotorScale);
  return state;
}

}  // namespace

bool is_answered_by_state(Type command) {
  static constexpr std::array kCommands = {Type::accelerations, Type::drive, Type::get_state,
                                           Type::stop,          Type::limp,  Type::configure_sonars,
                                           Type::set_watchdog};
  return std::ranges::find(kCommands, command) != kCommands.end();
}

Result<State> parse_state(const Message& message) {
  if (message.type == Type::nak)
    return fail(Code::unavailable, "the robot did not understand the command (NAK); send it again");
  if (!is_answered_by_state(message.type))
    return fail(Code::invalid_argument,
                "an answer of type " + std::to_string(static_cast<int>(message.type)) + " holds no state");
  if (message.payload.size() != kStateSize)
    return fail(Code::data_loss,
                "a state of " + std::to_string(message.payload.size()) +
                    " bytes; that of a Scout has 42: is this another robot, or one with a laser?");
  return read_state(message.payload);
}

}  // namespace orca::hw::nomad_scout
