// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

namespace orca {

/// How many descriptors this process has open.
[[nodiscard]] int count_descriptors();

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
