// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/framing/scanner.hpp"
#include "orca/hw/line_counts.hpp"
#include "orca/hw/link/byte_link.hpp"

namespace orca::hw {

/// Reads what there is and calls sink(const framing::Frame&, TimePoint) for each frame that it completes, with the time at which
/// the frame's first byte began to leave the device, by the time that the line takes for a byte.
/// @errors  those of ByteLink::read().
/// @thread  the link's.
template <class Sink>
Status read_frames(link::ByteLink& link, framing::Scanner& scanner, TimePoint now, Sink&& sink) {
  std::array<std::uint8_t, 1024> bytes{};
  for (;;) {
    const Result<std::size_t> count = link.read(bytes);
    if (!count) return count.error();
    if (*count == 0) return ok();
    const std::uint64_t after = scanner.received() + *count;
    scanner.feed({bytes.data(), *count}, [&](const framing::Frame& frame) {
      const double age = static_cast<double>(after - frame.begin) * link.byte_time();
      sink(frame, now - Duration(std::llround(1e9 * age)));
    });
  }
}

/// Returns a scanner's counters as a driver reports them.
[[nodiscard]] inline LineCounts counts_of(const framing::Statistics& all) {
  return {all.frames, all.bad_checksums, all.skipped_bytes, all.resynchronisations};
}

}  // namespace orca::hw
