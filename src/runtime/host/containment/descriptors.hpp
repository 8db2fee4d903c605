// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace orca::host {

/// What is open at a descriptor.
struct OpenFile {
  dev_t device = 0;
  ino_t inode = 0;
  std::string name;  ///< For people, in the system's words: "/dev/ttyS0", "socket:[4711]".

  /// Whether both are the same file; it may have been renamed meanwhile.
  friend bool operator==(const OpenFile& a, const OpenFile& b) {
    return a.device == b.device && a.inode == b.inode;
  }
};

/// By number.
using Descriptors = std::map<int, OpenFile>;

/// What this process has open; nothing if that cannot be told, because there is no descriptor left to look
/// with.
[[nodiscard]] std::optional<Descriptors> open_descriptors();

/// For people: "7 (/dev/ttyS0), 8 (socket:[4711])"; of many only the first.
[[nodiscard]] std::string names_of(const Descriptors& descriptors);

/// Descriptors that the process itself needs, to be seen to when a plugin closes what is not its own.
///
/// Thread contract: one thread at a time.
class OwnDescriptors {
 public:
  ~OwnDescriptors() { release(); }
  /// Remembers stdin, stdout and stderr as far as they are open, and one more.
  void remember();
  void release();
  [[nodiscard]] bool all_open() const;
  /// The number that the next descriptor would get; -1 if the process may open no more.
  [[nodiscard]] int lowest_free() const;

 private:
  std::vector<int> own_;
  int extra_ = -1;
};

}  // namespace orca::host
