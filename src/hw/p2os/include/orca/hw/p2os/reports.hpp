// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "orca/hw/framing/short_list.hpp"
#include "orca/hw/p2os/packet.hpp"

namespace orca::hw::p2os {

/// Counts of both wheels since the controller was reset, forward positive.
struct EncoderReport {
  std::int32_t left = 0;
  std::int32_t right = 0;
  friend bool operator==(const EncoderReport&, const EncoderReport&) = default;
};

/// A reading of the gyro. Its scale differs between gyros, so it is left in counts.
struct GyroReading {
  int rate = 0;                  ///< [counts] -512 to 511; 0: the robot does not turn.
  std::uint8_t temperature = 0;  ///< [counts]
  friend bool operator==(const GyroReading&, const GyroReading&) = default;
};

using GyroReport = framing::ShortList<GyroReading, kLongestBody / 3>;

/// State of all ports for user devices.
struct IoReport {
  framing::ShortList<std::uint8_t, kLongestBody> digital_in;   ///< A bit per line.
  framing::ShortList<std::uint8_t, kLongestBody> digital_out;  ///< A bit per line.
  framing::ShortList<std::uint16_t, kLongestBody / 2> analog;  ///< [counts]
  friend bool operator==(const IoReport&, const IoReport&) = default;
};

/// Each of these returns nothing if the body is of another type or shorter than it says.
[[nodiscard]] std::optional<EncoderReport> parse_encoder(std::span<const std::uint8_t> body);
[[nodiscard]] std::optional<GyroReport> parse_gyro(std::span<const std::uint8_t> body);
[[nodiscard]] std::optional<IoReport> parse_io(std::span<const std::uint8_t> body);

/// Returns the bytes that a device at an auxiliary port has sent.
/// @param port  PacketType::aux1 or aux2.
[[nodiscard]] std::optional<std::span<const std::uint8_t>> parse_aux(std::span<const std::uint8_t> body,
                                                                     PacketType port);

}  // namespace orca::hw::p2os
