// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/arrivals.hpp"
#include "orca/hw/framing/scanner.hpp"
#include "orca/hw/line_counts.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::hw {

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
