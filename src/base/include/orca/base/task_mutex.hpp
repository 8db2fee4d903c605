// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <mutex>

#include "orca/base/executive.hpp"

namespace orca {

/// A mutex between tasks of one executive: where they cannot overlap it does nothing. It must not be held
/// across a wait.
///
/// Thread contract: tasks of the executive only; what other threads touch needs more.
class TaskMutex {
 public:
  explicit TaskMutex(const Executive& executive) : needed_(executive.tasks_overlap()) {}

  void lock() {
    if (needed_) mutex_.lock();
  }
  void unlock() {
    if (needed_) mutex_.unlock();
  }

 private:
  std::mutex mutex_;
  const bool needed_;
};

}  // namespace orca
