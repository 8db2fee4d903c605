// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>

#include "descriptors.hpp"
#include "watch.hpp"

namespace orca::host {

/// The descriptors of the process: whether its own are open, whether there are any left, and who opens many
/// in its turns and closes none.
///
/// As soon as 32 more are open than at first, new ones are counted for the component in whose turn alone they
/// appeared; of one that has 32 open, this is reported. What is opened in turns of several is nobody's.
///
/// Thread contract: one thread at a time.
class DescriptorWatch {
 public:
  void keep();
  void let_go() { own_.release(); }

  /// Whether somebody has closed descriptors that the process itself needs.
  [[nodiscard]] bool own_are_closed() const { return !own_.all_open(); }
  /// Whether so many are open that each turn must be looked at.
  [[nodiscard]] bool is_crowded() const { return last_ - first_ >= kMany; }

  /// Accepts what is open now, after a hook that may open what others close.
  void accept();
  /// Looks who has opened what.
  /// @param alone  the only component that had a turn since the last look; null: there were several, or none.
  std::optional<Finding> look(const std::string* alone);

 private:
  static constexpr int kMany = 32;  // more than a component has reason to open in its laps

  std::optional<Finding> look_for_exhaustion();
  std::optional<Finding> count_for(const std::string& who);

  OwnDescriptors own_;
  int first_ = 0;  // lowest free descriptor at first,
  int last_ = 0;   // and at the last look
  bool exhausted_ = false;
  std::optional<Descriptors> known_;              // at the last look in a crowd
  std::map<std::string, Descriptors> opened_by_;  // in a crowd, and still open
};

/// What a component opened in start() and stop() and has not closed by the end of stop(). It is known only if
/// nobody else had a turn during these hooks.
///
/// Thread contract: one thread at a time.
class DescriptorBalance {
 public:
  /// A hook begins.
  /// @param anew   it is start(): what was opened before is forgotten.
  /// @param alone  nobody else has a turn at the moment.
  void begin(bool anew, bool alone);
  /// The hook is over.
  /// @param alone  nobody else had a turn since it began.
  void end(bool alone);
  /// What is still open; nothing if that is not known.
  [[nodiscard]] Descriptors left_open() const { return known_ ? opened_ : Descriptors{}; }

 private:
  Descriptors at_begin_;
  Descriptors opened_;
  bool known_ = true;
};

}  // namespace orca::host
