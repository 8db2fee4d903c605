// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>

namespace orca::hw::link {

enum class Parity { none, even };

/// How bytes go over a line that has a rate: one start bit, eight data bits, the parity bit if there is one, one stop
/// bit. There is no flow control.
struct Line {
  std::uint32_t baud = 9600;  ///< [bit/s]
  Parity parity = Parity::none;
  std::chrono::microseconds pause{0};  ///< Time that the device needs between two bytes that it is sent [us].

  /// Returns the time that one byte takes [s].
  /// @pre  baud > 0
  [[nodiscard]] double byte_time() const { return (parity == Parity::none ? 10.0 : 11.0) / baud; }

  bool operator==(const Line&) const = default;
};

}  // namespace orca::hw::link
