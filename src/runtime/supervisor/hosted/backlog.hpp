// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// What a host process has to say while it has no supervisor: lines of the log, alarms, results, in their order. What only
/// matters at its moment is not kept. Beyond kMost the oldest lines of the log are given up, then the oldest of the rest.
///
/// Thread contract: not synchronised.
class Backlog {
 public:
  static constexpr std::size_t kMost = 2000;
  static constexpr std::size_t kLongestLine = 2000;  ///< [bytes]; the middle of a longer one is left out.

  /// Keeps a report, if it still means something later.
  /// @param time  of the run, which a line of the log then tells.
  void keep(Report report, Duration time);
  /// Takes everything out. If something was given up, a line of the log at the end says how much.
  [[nodiscard]] std::vector<Report> take();

 private:
  void give_up_one();

  std::deque<Report> kept_;
  std::uint64_t given_up_ = 0;
};

}  // namespace orca::supervisor
