// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/base/system/processor_wait.hpp"

namespace orca::detail {

/// A counter that shows whether a task on its own thread waits, and how often it has waited. A wait costs the
/// task two stores.
///
/// Thread contract: written by its task, read from anywhere.
class WaitCount {
 public:
  /// @param name  name of the task.
  explicit WaitCount(std::string name) : name_(std::move(name)) {}

  /// Makes the calling thread the task's own.
  void attach();
  /// Returns the counter of the calling thread; null if it runs no task.
  [[nodiscard]] static WaitCount* current();

  void begin() { state_.store(state_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed); }
  void end() { begin(); }

  /// Lets nobody watch the task from now on.
  void leave_watch() { is_watched_.store(false, std::memory_order_relaxed); }
  [[nodiscard]] bool is_watched() const { return is_watched_.load(std::memory_order_relaxed); }

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Returns the task's own thread; 0: it has none yet.
  [[nodiscard]] pid_t thread() const { return thread_.load(std::memory_order_relaxed); }
  /// Returns an odd number while the task waits, and another number after each wait.
  [[nodiscard]] std::uint64_t state() const { return state_.load(std::memory_order_relaxed); }

 private:
  const std::string name_;
  std::atomic<bool> is_watched_{true};
  std::atomic<std::uint64_t> state_{0};
  std::atomic<pid_t> thread_{0};
};

/// A scope during which the task of the calling thread counts as waiting.
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

/// A watch over tasks that have not waited for a long time. Time in which a task waits for a processor does not count.
///
/// Thread contract: any thread.
class ThreadWatch {
 public:
  void add(const WaitCount& count);
  void remove(const WaitCount& count);

  /// Returns the task that was the last to cross the limit, if any has.
  [[nodiscard]] std::optional<StuckTask> stuck_task(Duration limit);

 private:
  struct Watched {
    const WaitCount* count;
    std::uint64_t state;
    TimePoint since;  // when it was first seen in this state, then when it was for the second time
    std::optional<ProcessorWait> wait{};  // from the second time on
    Duration waited_before{0};            // as wait reported it then
  };
  static Duration busy_time(Watched& watched, TimePoint now);

  std::mutex mutex_;
  std::vector<Watched> watched_;
};

}  // namespace orca::detail
