// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "orca/base/executive.hpp"

namespace orca {

/// Threads that share a loop with the one that calls, for work that is the same in whatever order it is done:
/// then the result does not depend on how many they are. To the clock the loop takes no time, also on virtual
/// time, where a plugin may start no threads of its own.
///
/// Thread contract: one loop at a time, from any thread.
class Team {
 public:
  /// @param threads  who works at once, the caller among them; 0: as many as the processor has. If the system
  ///                 refuses some of them, the others do their work.
  explicit Team(unsigned threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Calls work(i) once for each i below `count`, and returns when all is done. `work` must neither wait for
  /// another i nor block on a port, a task or the clock; what it writes must be its own i's.
  ///
  /// What it throws does not keep it from the others; the exception of the least i is thrown on afterwards.
  void for_all(std::size_t count, const std::function<void(std::size_t)>& work);

  /// Who works at once, the caller among them.
  [[nodiscard]] unsigned threads() const { return static_cast<unsigned>(helpers_.size()) + 1; }

 private:
  class Loop;
  struct Helper;

  void help(Helper& self);
  void wake_helpers();
  void wait_for_helpers(const Loop& loop);

  std::mutex mutex_;
  Loop* loop_ = nullptr;  // The present one; guarded, as `ended_`.
  bool ended_ = false;
  std::unique_ptr<Event> helpers_left_;
  std::vector<std::unique_ptr<Helper>> helpers_;
};

}  // namespace orca
