// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/stat.h>

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace orca {

/// The files that this process reads and writes, by path. Two paths are the same file if they lead to the same
/// place on the disk at the time of the question, so that a file that was replaced stays protected.
///
/// Thread contract: any thread.
class UsedFiles {
 public:
  [[nodiscard]] static UsedFiles& of_process();

  void add_read(const std::string& path);
  void add_named(const std::string& path);
  void add_written(const std::string& path, const std::string& what);
  void remove_written(const std::string& path);

  /// Returns the files that are read or named.
  [[nodiscard]] std::vector<std::string> inputs() const;
  [[nodiscard]] bool is_read(const struct stat& file) const;
  /// Returns the use of a file for people: "a file that has been read", "a file that the graph names", or what is
  /// written there, such as "the trace"; empty: not in use.
  [[nodiscard]] std::string use_of(const struct stat& file) const;

 private:
  mutable std::mutex mutex_;
  std::set<std::string> read_;
  std::set<std::string> named_;
  std::map<std::string, std::string> written_;
};

}  // namespace orca
