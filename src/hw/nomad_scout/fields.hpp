// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>

#include "orca/hw/framing/byte_reader.hpp"
#include "orca/hw/nomad_scout/number.hpp"
#include "orca/hw/nomad_scout/state.hpp"

// Fields that the state and the answers for one group have in common.
namespace orca::hw::nomad_scout {

inline int read_signed(framing::ByteReader& reader) { return from_sign_and_magnitude(reader.u16()); }

inline double read_angle(framing::ByteReader& reader) { return wrapped(radians(read_signed(reader))); }

inline SonarRanges read_sonars(framing::ByteReader& reader) {
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
inline std::uint32_t read_bumpers(framing::ByteReader& reader) {
  const std::uint32_t low = reader.u16();
  return low + (std::uint32_t{reader.u8()} << 16);
}

inline RawPosition read_position(framing::ByteReader& reader) {
  const int x = read_signed(reader);
  return {x, read_signed(reader)};
}

// Right wheel, left wheel, turret.
inline Wheels read_speeds(framing::ByteReader& reader) {
  const double right = read_signed(reader) * kLengthUnit;
  const double left = read_signed(reader) * kLengthUnit;
  reader.u16();
  return {.left = left, .right = right};
}

inline Duration read_time(framing::ByteReader& reader) { return std::chrono::milliseconds(reader.u32()); }

}  // namespace orca::hw::nomad_scout
