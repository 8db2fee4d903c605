// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/log.hpp"

namespace orca::logs {

/// The lines that this process has written to its log and that nobody has taken yet. When there are too many, new ones
/// are lost and counted.
///
/// Thread contract: hear() from anywhere, the rest from one thread at a time.
class HeardLines {
 public:
  struct Line {
    log::Level level;
    std::string who;
    std::string text;
    TimePoint time;
  };

  /// @param lowest  level from which on lines are kept.
  explicit HeardLines(log::Level lowest) : lowest_(lowest) {}

  void hear(const log::Line& line) {
    if (line.level < lowest_) return;
    const std::lock_guard lock(mutex_);
    if (lines_.size() < kMost) {
      lines_.push_back({line.level, std::string(line.who), std::string(line.text), line.time});
    } else {
      ++lost_;
    }
  }

  /// Returns the lines since the last call, in the order in which they were written.
  [[nodiscard]] std::vector<Line> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(lines_, {});
  }
  /// Returns how many lines were lost since the last call.
  [[nodiscard]] std::size_t take_lost() {
    const std::lock_guard lock(mutex_);
    return std::exchange(lost_, 0);
  }

 private:
  static constexpr std::size_t kMost = 10'000;

  const log::Level lowest_;
  std::mutex mutex_;
  std::vector<Line> lines_;
  std::size_t lost_ = 0;
};

}  // namespace orca::logs
