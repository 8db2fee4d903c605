// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace orca {

/// Descriptors and what is open there, in the system's words: "/dev/ttyS0", "socket:[4711]".
using Descriptors = std::set<std::pair<int, std::string>>;

/// What this process has open.
[[nodiscard]] Descriptors open_descriptors();

/// For people: "7 (/dev/ttyS0), 8 (socket:[4711])".
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

}  // namespace orca
