// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/command.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::p2os {
namespace {

using Body = framing::FrameBytes<kLongestBody>;

constexpr unsigned kPositive = 0x3B;
constexpr unsigned kNegative = 0x1B;
constexpr unsigned kList = 0x2B;

unsigned number_of(Command command) { return static_cast<unsigned>(command); }

int whole(double value) {
  return std::isfinite(value) ? static_cast<int>(std::lround(std::clamp(value, -32767.0, 32767.0))) : 0;
}

ReceivedCommand with_integer(std::uint8_t number, bool is_negative, framing::ByteReader& reader) {
  using Argument = ReceivedCommand::Argument;
  if (reader.remaining() < 2) return {.number = number, .argument = Argument::cut_short};
  const int magnitude = reader.u16();
  return {.number = number, .argument = Argument::integer, .value = is_negative ? -magnitude : magnitude};
}

ReceivedCommand with_list(std::uint8_t number, framing::ByteReader& reader) {
  using Argument = ReceivedCommand::Argument;
  const bool has_length = reader.remaining() > 0;
  const std::size_t length = reader.u8();
  const auto bytes = reader.bytes(length);
  const bool is_whole = has_length && bytes.size() == length;
  return {.number = number, .argument = is_whole ? Argument::bytes : Argument::cut_short, .bytes = bytes};
}

}  // namespace

Packet encode(Command command) { return make_packet(Body().u8(number_of(command)).view()); }

Packet encode(Command command, int value) {
  const int limited = std::clamp(value, -32768, 65535);
  const auto magnitude = static_cast<unsigned>(std::abs(limited));
  return make_packet(
      Body().u8(number_of(command)).u8(limited < 0 ? kNegative : kPositive).u16(magnitude).view());
}

Result<Packet> encode(Command command, std::span<const std::uint8_t> bytes) {
  if (bytes.size() > kLongestArgument)
    return fail(Code::invalid_argument, "a command with " + std::to_string(bytes.size()) +
                                            " bytes; the robot takes at most " +
                                            std::to_string(kLongestArgument) + "; send them in parts");
  Body body;
  body.u8(number_of(command)).u8(kList).u8(static_cast<unsigned>(bytes.size())).append(bytes);
  return make_packet(body.view());
}

Packet sync(int step) { return make_packet(Body().u8(static_cast<unsigned>(step)).view()); }

Packet encode_speed(double speed) { return encode(Command::vel, whole(1000.0 * speed)); }

Packet encode_turn_rate(double turn_rate) {
  return encode(Command::rvel, whole(turn_rate * 180.0 / std::numbers::pi));
}

WheelSteps wheel_steps(const Twist2& twist, const Model& model) {
  if (!is_finite(twist)) return {};
  const double turning = twist.turn_rate * model.half_track;
  const double left = (twist.forward - turning) / model.wheel_step;
  const double right = (twist.forward + turning) / model.wheel_step;
  const double most = std::max(std::abs(left), std::abs(right));
  const double scale = most > kMostWheelSteps ? kMostWheelSteps / most : 1.0;
  return {whole(left * scale), whole(right * scale)};
}

Packet encode_wheels(WheelSteps steps) {
  const int left = std::clamp(steps.left, -kMostWheelSteps, kMostWheelSteps);
  const int right = std::clamp(steps.right, -kMostWheelSteps, kMostWheelSteps);
  // The right byte must not borrow from the left one, so they are put together as bits.
  return encode(Command::vel2, left * 256 + (right & 0xFF));
}

WheelSteps wheel_steps_of(int argument) {
  const auto bits = static_cast<unsigned>(argument);
  return {static_cast<std::int8_t>((bits >> 8) & 0xFF), static_cast<std::int8_t>(bits & 0xFF)};
}

std::optional<ReceivedCommand> decode_command(std::span<const std::uint8_t> body) {
  if (body.empty()) return std::nullopt;
  framing::ByteReader reader(body);
  const std::uint8_t number = reader.u8();
  if (reader.remaining() == 0) return ReceivedCommand{.number = number};
  switch (reader.u8()) {
    case kPositive: return with_integer(number, false, reader);
    case kNegative: return with_integer(number, true, reader);
    case kList: return with_list(number, reader);
    default: return ReceivedCommand{.number = number, .argument = ReceivedCommand::Argument::cut_short};
  }
}

}  // namespace orca::hw::p2os
