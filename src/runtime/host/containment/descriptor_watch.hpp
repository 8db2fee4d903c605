// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>

#include "descriptors.hpp"
#include "watch.hpp"

namespace orca::host {

/// A watch over the descriptors of the process. It reports closed or redirected descriptors that the process itself
/// needs, a process that has none left, and a component that opens many during its turns and closes none.
///
/// As soon as 32 more are open than at first, each new one is counted for the component that alone had a turn
/// since the last look. A component that has 32 of them open is reported. Descriptors that appear while
/// several components have turns are counted for none.
///
/// Thread contract: one thread at a time.
class DescriptorWatch {
 public:
  void keep();
  void let_go() { own_.release(); }

  /// Returns whether a descriptor that the process itself needs has been closed.
  [[nodiscard]] bool own_are_closed() const { return !own_.all_open(); }
  /// Restores stdin, stdout and stderr, and reports which of them had been redirected.
  std::optional<Finding> look_at_streams();
  /// Returns whether so many are open that every turn must be checked.
  [[nodiscard]] bool is_crowded() const { return last_ - first_ >= kMany; }

  /// Accepts the open descriptors as they are, after a hook that may open what others close.
  void accept();
  /// Finds the component that has opened too many descriptors, or reports that the process has none left.
  /// @param alone  the only component that had a turn since the last look; null: there were several, or none.
  std::optional<Finding> look(const std::string* alone);

 private:
  static constexpr int kMany = 32;  // more than a component has reason to open in its laps

  std::optional<Finding> look_for_exhaustion();
  std::optional<Finding> count_for(const std::string& who);

  OwnDescriptors own_;
  int first_ = 0;  // lowest free descriptor at first
  int last_ = 0;   // lowest free descriptor at the last look
  bool exhausted_ = false;
  std::optional<Descriptors> known_;              // at the last look while crowded
  std::map<std::string, Descriptors> opened_by_;  // opened while crowded, and still open
};

/// The descriptors that a component opened in start() and stop() and has not closed by the end of stop().
/// They are known only if no other component had a turn during these hooks.
///
/// Thread contract: one thread at a time.
class DescriptorBalance {
 public:
  /// Notes that a hook begins.
  /// @param anew   it is start(): earlier openings are forgotten.
  /// @param alone  no other component has a turn at the moment.
  /// @param open   the open descriptors, if they are known already; null: they are read.
  void begin(bool anew, bool alone, const Descriptors* open = nullptr);
  /// Notes that the hook is over.
  /// @param alone  no other component had a turn since it began.
  void end(bool alone);
  /// Returns the descriptors that are still open; none if they are not known.
  [[nodiscard]] Descriptors left_open() const { return known_ ? opened_ : Descriptors{}; }

 private:
  Descriptors at_begin_;
  Descriptors opened_;
  bool known_ = true;
};

}  // namespace orca::host
