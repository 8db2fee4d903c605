// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/emulators/firmware.hpp"

#include <algorithm>
#include <cmath>

namespace orca::emulators {

void OutgoingLine::send(std::span<const std::uint8_t> bytes, double byte_time, TimePoint now) {
  TimePoint leaves = std::max(now, idle_at());
  for (const std::uint8_t byte : bytes) {
    leaves += Duration(std::llround(1e9 * byte_time));
    waiting_.push_back({byte, leaves});
  }
}

std::vector<std::uint8_t> OutgoingLine::leave(TimePoint now, bool at_hosts_rate) {
  std::vector<std::uint8_t> out;
  for (; !waiting_.empty() && waiting_.front().leaves <= now; waiting_.pop_front()) {
    const std::uint8_t byte = waiting_.front().byte;
    out.push_back(at_hosts_rate ? byte : static_cast<std::uint8_t>(byte * 37 + 11));
  }
  return out;
}

}  // namespace orca::emulators
