// SPDX-License-Identifier: LGPL-3.0-or-later
#include "line_limit.hpp"

#include <utility>

namespace orca::host {

std::optional<std::uint64_t> LineLimit::admit(const std::string& about, TimePoint now) {
  Entry& entry = entries_.try_emplace(about, Entry{now}).first->second;
  if (now < entry.next) {
    ++entry.left_out;
    return std::nullopt;
  }
  entry.next = saturating_add(now, interval_);
  return std::exchange(entry.left_out, 0);
}

}  // namespace orca::host
