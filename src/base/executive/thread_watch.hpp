// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/executive.hpp"

namespace orca::detail {

/// Whether a task on a thread of its own waits, and how often it has. A wait costs it two stores.
///
/// Thread contract: written by its task, read from anywhere.
class WaitCount {
 public:
  /// @param name  of the task.
  explicit WaitCount(std::string name) : name_(std::move(name)) {}

  /// From now on the calling thread is the task's.
  void attach();
  /// Of the calling thread; null: it runs no task.
  [[nodiscard]] static WaitCount* current();

  void begin() { state_.store(state_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed); }
  void end() { begin(); }

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Odd while it waits; another value after each wait.
  [[nodiscard]] std::uint64_t state() const { return state_.load(std::memory_order_relaxed); }

 private:
  const std::string name_;
  std::atomic<std::uint64_t> state_{0};
};

/// As long as it lives, the task of this thread waits.
class Waiting {
 public:
  Waiting() : count_(WaitCount::current()) {
    if (count_ != nullptr) count_->begin();
  }
  ~Waiting() {
    if (count_ != nullptr) count_->end();
  }
  Waiting(const Waiting&) = delete;
  Waiting& operator=(const Waiting&) = delete;

 private:
  WaitCount* const count_;
};

/// Finds the tasks that have not waited for long.
///
/// Thread contract: any thread.
class ThreadWatch {
 public:
  void add(const WaitCount& count);
  void remove(const WaitCount& count);

  /// The task that has crossed the limit last, if any has.
  [[nodiscard]] std::optional<StuckTask> stuck_task(Duration limit);

 private:
  struct Watched {
    const WaitCount* count;
    std::uint64_t state;
    TimePoint since;  // when it was first seen in this state
  };

  std::mutex mutex_;
  std::vector<Watched> watched_;
};

}  // namespace orca::detail
