// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <utility>

namespace orca::host {

/// Who has taken how many of something more than given back, told from how many are taken before and after
/// each turn.
///
/// Thread contract: one thread at a time.
class Growth {
 public:
  void start(int taken);
  /// How many more than at the start are taken.
  [[nodiscard]] int total() const { return last_ - first_; }
  /// @param taken  now; what it has risen since the last call is the work of `who`.
  /// @return how many `who` has taken and not given back.
  int take(const std::string& who, int taken);
  /// What it has risen is nobody's or somebody's good right.
  void accept(int taken) { first_ += taken - std::exchange(last_, taken); }
  /// What it has risen is the work of one of several.
  void skip_to(int taken) { last_ = taken; }

 private:
  int first_ = 0;
  int last_ = 0;
  std::map<std::string, int> by_who_;
};

/// How much memory this process has asked of the system [pages], touched or not.
[[nodiscard]] int count_memory_pages();

}  // namespace orca::host
