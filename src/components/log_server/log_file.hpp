// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "orca/base/result.hpp"

namespace orca::logs {

/// A file of lines that never grows beyond a size: then it becomes NAME.1, NAME.1 becomes NAME.2 and so on,
/// and the oldest goes. What cannot be written (disk full, device gone) is counted and lost, line by line,
/// never half a line; when writing works again a line says how many were lost.
///
/// Thread contract: not synchronised.
class LogFile {
 public:
  /// @param most_bytes  of one file; a line that is longer alone still gets a file of its own.
  /// @param keep        old files besides the one that is written to.
  LogFile(std::string path, std::uint64_t most_bytes, int keep);
  ~LogFile();
  LogFile(const LogFile&) = delete;
  LogFile& operator=(const LogFile&) = delete;

  /// Opens the file for writing at its end.
  /// @errors  unavailable with the system's reason.
  Status open();

  /// Adds a line; without line breaks, which are shown as \n.
  /// @return false if it was lost.
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
  bool regular_ = false;  // else (a pipe, a terminal) there is nothing to rotate or cut
  std::uint64_t size_ = 0;
  std::uint64_t written_ = 0;
  std::uint64_t lost_ = 0;
  std::uint64_t told_lost_ = 0;
};

}  // namespace orca::logs
