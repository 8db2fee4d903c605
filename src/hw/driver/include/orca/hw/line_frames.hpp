// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/framing/scanner.hpp"
#include "orca/hw/line_counts.hpp"
#include "orca/hw/link/byte_link.hpp"

/// The frames that come over a line, and when their bytes left the device.
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

/// The frames that come over a line, each with the time at which its first byte left the device (see Arrivals). To begin anew, assign
/// a new one.
///
/// Thread contract: not synchronised; the line's strand.
class LineFrames {
 public:
  /// @pre  as for framing::Scanner.
  explicit LineFrames(const framing::Protocol& protocol) : scanner_(protocol) {}

  /// Reads what there is and calls sink(const framing::Frame&, TimePoint sent) for each frame that it completes.
  /// @errors  those of ByteLink::read().
  template <class Sink>
  Status read(link::ByteLink& link, TimePoint now, Sink&& sink) {
    std::array<std::uint8_t, 1024> bytes{};
    for (;;) {
      const Result<std::size_t> count = link.read(bytes);
      if (!count) return count.error();
      if (*count == 0) return ok();
      arrivals_.note(scanner_.received() + *count, now, link.byte_time());
      scanner_.feed({bytes.data(), *count},
                    [&](const framing::Frame& frame) { sink(frame, arrivals_.of(frame.begin)); });
      arrivals_.forget(scanner_.received() - scanner_.waiting());
    }
  }

  /// Gives up the frame whose end is missing, as Scanner::give_up(); the sink is that of read().
  template <class Sink>
  void give_up(Sink&& sink) {
    scanner_.give_up([&](const framing::Frame& frame) { sink(frame, arrivals_.of(frame.begin)); });
  }

  [[nodiscard]] const framing::Statistics& statistics() const { return scanner_.statistics(); }

 private:
  framing::Scanner scanner_;
  Arrivals arrivals_;
};

/// Returns a scanner's counters as a driver reports them.
[[nodiscard]] inline LineCounts counts_of(const framing::Statistics& all) {
  return {all.frames, all.bad_checksums, all.skipped_bytes, all.resynchronisations};
}

}  // namespace orca::hw
