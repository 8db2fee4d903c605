// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/nomad_scout/state.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "fields.hpp"

namespace orca::hw::nomad_scout {
namespace {

constexpr std::size_t kStateSize = 42;
constexpr double kProcessorScale = 12.0;  // [V]
constexpr double kMotorScale = 12.85;     // [V]

double voltage(std::uint8_t raw, double scale) { return (2.0 + 3.0 * raw / 255.0) * scale / 5.0; }

State read_state(std::span<const std::uint8_t> payload) {
  framing::ByteReader reader(payload);
  State state;
  state.sonars = read_sonars(reader);
  state.bumpers = read_bumpers(reader);
  state.position = read_position(reader);
  state.heading = read_angle(reader);
  state.turret = read_angle(reader);
  state.speeds = read_speeds(reader);
  state.compass = radians(read_signed(reader));
  const unsigned motors = reader.u8();
  state.drives = (motors & 1U) != 0;
  state.turns = (motors & 2U) != 0;
  state.turret_turns = (motors & 4U) != 0;
  state.controller_time = read_time(reader);
  state.processor_voltage = voltage(reader.u8(), kProcessorScale);
  state.motor_voltage = voltage(reader.u8(), kMotorScale);
  return state;
}

}  // namespace

bool is_answered_by_state(Type command) {
  static constexpr std::array kCommands = {Type::accelerations, Type::speeds,
                                           Type::move,          Type::drive,
                                           Type::get_state,     Type::stop,
                                           Type::limp,          Type::define_position,
                                           Type::zero,          Type::configure_sonars,
                                           Type::set_watchdog,  Type::define_angles,
                                           Type::wait,          Type::configure_port,
                                           Type::axes};
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
