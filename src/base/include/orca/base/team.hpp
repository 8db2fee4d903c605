// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/base/mutex.hpp"

namespace orca {

/// A group of threads that shares a loop with the calling thread. It is for work whose result does not depend
/// on the order, so that the number of threads does not matter. The loop takes no virtual time, and may be
/// used in virtual time, where a plugin may not start threads of its own.
///
/// Thread contract: one loop at a time, from any thread.
class Team {
 public:
  /// @param threads  number of threads, including the caller; 0: one per processor. If the system refuses
  ///                 some of them, the others do their work.
  explicit Team(unsigned threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  /// Calls work(i) once for each i below `count`, and returns when all calls have ended. A call must not wait
  /// for another i, and must not block on a port, a task or the clock. It may write only data that belongs to
  /// its own i.
  ///
  /// An exception does not stop the other calls. Afterwards the exception of the smallest i is rethrown.
  void for_all(std::size_t count, const std::function<void(std::size_t)>& work);

  /// Returns the number of threads, including the caller.
  [[nodiscard]] unsigned threads() const { return static_cast<unsigned>(helpers_.size()) + 1; }

 private:
  class Loop;
  struct Helper;

  void help(Helper& self);
  void wake_helpers();
  void wait_for_helpers(const Loop& loop);

  Mutex mutex_;
  Loop* loop_ ORCA_GUARDED_BY(mutex_) = nullptr;  // in progress
  bool ended_ ORCA_GUARDED_BY(mutex_) = false;
  std::unique_ptr<Event> helpers_left_;
  std::vector<std::unique_ptr<Helper>> helpers_;
};

}  // namespace orca
