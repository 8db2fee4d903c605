// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

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

}  // namespace orca::logs
