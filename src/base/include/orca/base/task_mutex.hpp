// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <mutex>

#include "orca/base/executive.hpp"

namespace orca {

/// A mutex between tasks of one executive. It does nothing where tasks cannot overlap. It must not be held
/// across a wait.
///
/// Thread contract: tasks of the executive only; data that other threads touch needs another lock.
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
