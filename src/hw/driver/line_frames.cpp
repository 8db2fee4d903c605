// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/line_frames.hpp"

#include <algorithm>

namespace orca::hw {

TimePoint Arrivals::Read::of(std::uint64_t byte) const {
  return time - from_seconds(static_cast<double>(after - byte) * byte_time);
}

// A read of before is worth nothing if this one puts its last byte, and so all before, at an earlier time.
void Arrivals::note(std::uint64_t after, TimePoint now, double byte_time) {
  const Read read{after, now, byte_time};
  while (!reads_.empty() && read.of(reads_.back().after) <= reads_.back().time) reads_.pop_back();
  reads_.push_back(read);
}

void Arrivals::forget(std::uint64_t first) {
  std::erase_if(reads_, [&](const Read& read) { return read.after <= first; });
}

TimePoint Arrivals::of(std::uint64_t byte) const {
  return std::ranges::find_if(reads_, [&](const Read& read) { return read.after > byte; })->of(byte);
}

}  // namespace orca::hw
