// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

namespace orca::hw {

/// What a driver has read from its device's line. A plain value.
struct LineCounts {
  std::uint64_t frames = 0;              ///< That were good.
  std::uint64_t bad_checksums = 0;       ///< Frames that were spoiled.
  std::uint64_t skipped_bytes = 0;       ///< That belong to no good frame.
  std::uint64_t resynchronisations = 0;  ///< Good frames after skipped bytes.

  LineCounts& operator+=(const LineCounts& more) {
    frames += more.frames;
    bad_checksums += more.bad_checksums;
    skipped_bytes += more.skipped_bytes;
    resynchronisations += more.resynchronisations;
    return *this;
  }
  friend bool operator==(const LineCounts&, const LineCounts&) = default;
};

}  // namespace orca::hw
