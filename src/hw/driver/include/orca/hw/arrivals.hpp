// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "orca/base/time.hpp"

namespace orca::hw {

/// The times at which the bytes of a line left the device, as the reads tell that brought them.
///
/// A byte has left before it was read, and by the time of one byte before the one behind it. The earliest time that follows from all
/// reads counts, so a line that is slower than its rate, or that stalls within a frame, is not taken for a quick one. How long bytes
/// waited in the system before they were read cannot be known.
///
/// Thread contract: not synchronised; the line's strand.
class Arrivals {
 public:
  /// Notes that bytes were read.
  /// @param after      number of bytes of the stream that have been read with these.
  /// @param now        when they were read.
  /// @param byte_time  [s] that the line takes for a byte; 0: it has no rate.
  void note(std::uint64_t after, TimePoint now, double byte_time);
  /// Forgets the bytes before number `first`.
  void forget(std::uint64_t first);
  /// Returns when a byte left the device. @pre  it was read, and is not forgotten.
  [[nodiscard]] TimePoint of(std::uint64_t byte) const;

 private:
  struct Read {
    std::uint64_t after;
    TimePoint time;
    double byte_time;
    [[nodiscard]] TimePoint of(std::uint64_t byte) const;
  };
  std::vector<Read> reads_;  // the later ones tell of later times
};

}  // namespace orca::hw
