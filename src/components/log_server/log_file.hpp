// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/log.hpp"
#include "orca/base/result.hpp"

namespace orca::logs {

/// A file of lines with a largest size. A file that would exceed it becomes NAME.1, NAME.1 becomes NAME.2 and
/// so on, and the oldest is removed. A line that cannot be written (disk full, device gone) is lost whole and
/// counted. When writing works again, a line gives the number of lost lines.
///
/// Thread contract: not synchronised.
class LogFile {
 public:
  /// @param most_bytes  largest size of one file [bytes]; a longer line gets a file of its own.
  /// @param keep        number of old files besides the present one.
  LogFile(std::string path, std::uint64_t most_bytes, int keep);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// Opens the file for appending.
  /// @errors  unavailable with the system's reason.
  Status open();

  /// Appends a line. Line breaks in it are written as \n.
  /// @return false if the line was lost.
  bool append(std::string_view line);

  [[nodiscard]] std::uint64_t written() const { return written_; }
  [[nodiscard]] std::uint64_t lost() const { return lost_; }

 private:
  void rotate();
  bool write_line(const std::string& line);
  [[nodiscard]] std::string old_name(int number) const { return path_ + "." + std::to_string(number); }

  const std::string path_;
  const std::uint64_t most_bytes_;
  const int keep_;
  int fd_ = -1;
  bool regular_ = false;  // false: a pipe or a terminal, which cannot be rotated or cut
  std::uint64_t size_ = 0;
  std::uint64_t written_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t told_lost_ = 0;
};

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
