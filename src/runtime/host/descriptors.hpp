// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace orca {

/// How many descriptors this process has open.
[[nodiscard]] int count_descriptors();

/// Who has opened how many descriptors more than closed, told from the lowest free number before and after
/// each turn. It rises by less than what was opened as long as there are gaps, never by more.
///
/// Thread contract: one thread at a time.
class DescriptorGrowth {
 public:
  void start(int lowest_free);
  /// How many more than at the start are surely open.
  [[nodiscard]] int total() const { return last_ - first_; }
  /// @param lowest_free  now; what it has risen since the last call is the work of `who`.
  /// @return how many `who` has opened and not closed.
  int take(const std::string& who, int lowest_free);
  /// What it has risen is nobody's or somebody's good right.
  void accept(int lowest_free) { first_ += lowest_free - std::exchange(last_, lowest_free); }
  /// What it has risen is the work of one of several.
  void skip_to(int lowest_free) { last_ = lowest_free; }

 private:
  int first_ = 0;
  int last_ = 0;
  std::map<std::string, int> by_who_;
};

/// Descriptors that the process itself needs, to be seen to when a plugin closes what is not its own.
///
/// Thread contract: as DescriptorGrowth.
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
