// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/executive.hpp"
#include "orca/base/mutex.hpp"

namespace orca {

/// A mutex between tasks of one executive. It does nothing where tasks cannot overlap. It must not be held
/// across a wait.
///
/// Thread contract: tasks of the executive only; data that other threads touch needs another lock.
class ORCA_THREAD_WORD(capability("mutex")) TaskMutex {
 public:
  using Native = TaskMutex;

  explicit TaskMutex(const Executive& executive) : needed_(executive.tasks_overlap()) {}

  void lock() ORCA_ACQUIRES() {
    if (needed_) mutex_.lock();
  }
  void unlock() ORCA_RELEASES() {
    if (needed_) mutex_.unlock();
  }

 private:
  Mutex mutex_;
  const bool needed_;
};

}  // namespace orca
