// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "orca/base/time.hpp"

namespace orca::host {

/// A limit on how often lines about the same thing are written to the log.
///
/// Thread contract: one thread at a time.
class LineLimit {
 public:
  /// @param interval  shortest time between two lines about one thing [s].
  explicit LineLimit(Duration interval) : interval_(interval) {}

  /// Decides on one line.
  /// @param about  what the line is about. The names of all things are kept, so they should be few.
  /// @return nothing if the line is to be left out. Otherwise the number of lines that were left out since
  /// the last one that was written.
  [[nodiscard]] std::optional<std::uint64_t> admit(const std::string& about, TimePoint now) {
    Entry& entry = entries_.try_emplace(about, Entry{now}).first->second;
    if (now < entry.next) {
      ++entry.left_out;
      return std::nullopt;
    }
    entry.next = saturating_add(now, interval_);
    return std::exchange(entry.left_out, 0);
  }

 private:
  struct Entry {
    TimePoint next;  // earliest time of the next line
    std::uint64_t left_out = 0;
  };

  const Duration interval_;
  std::map<std::string, Entry> entries_;
};

/// Returns what a line says of those that were left out before it, as LineLimit counts them; empty if there was none.
/// @thread  pure function; any thread.
[[nodiscard]] inline std::string mention_left_out(std::uint64_t lines) {
  if (lines == 0) return {};
  return lines == 1 ? " (1 more such line was left out before)"
                    : " (" + std::to_string(lines) + " more such lines were left out before)";
}

}  // namespace orca::host
