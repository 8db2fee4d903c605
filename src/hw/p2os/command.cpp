// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/command.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::p2os {
namespace {

using Body = framing::FrameBytes<kLongestBody>;

constexpr unsigned kPositive = 0x3B;
constexpr unsigned kNegative = 0x1B;

unsigned number_of(Command command) { return static_cast<unsigned>(command); }

int whole(double value) {
  return std::isfinite(value) ? static_cast<int>(std::lround(std::clamp(value, -32767.0, 32767.0))) : 0;
}

}  // namespace

Packet encode(Command command) { return make_packet(Body().u8(number_of(command)).view()); }

Packet encode(Command command, int value) {
  const int limited = std::clamp(value, -32768, 65535);
  const auto magnitude = static_cast<unsigned>(std::abs(limited));
  return make_packet(
      Body().u8(number_of(command)).u8(limited < 0 ? kNegative : kPositive).u16(magnitude).view());
}

Packet sync(int step) { return make_packet(Body().u8(static_cast<unsigned>(step)).view()); }

Packet encode_speed(double speed) { return encode(Command::vel, whole(1000.0 * speed)); }

Packet encode_turn_rate(double turn_rate) {
  return encode(Command::rvel, whole(turn_rate * 180.0 / std::numbers::pi));
}

}  // namespace orca::hw::p2os
