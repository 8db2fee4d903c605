// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <pthread.h>

#include <atomic>
#include <functional>
#include <memory>

#include "orca/base/executive.hpp"
#include "orca/base/time.hpp"
#include "run/reporting/run_context.hpp"

namespace orca::host {

/// The processor time that one thread has taken, for others who judge whether it computes or sleeps.
///
/// Thread contract: start() on the thread; the rest on any.
class CandidateClock {
 public:
  void start() {
    clockid_t clock{};
    if (pthread_getcpuclockid(pthread_self(), &clock) == 0) clock_.store(clock);
  }
  /// Forgets the thread.
  void reset() { clock_.store(kNone); }
  /// Returns the time [s] since the thread began; 0 without a thread, or when that has ended.
  [[nodiscard]] Duration used() const {
    timespec used{};
    const clockid_t clock = clock_.load();
    if (clock == kNone || clock_gettime(clock, &used) != 0) return Duration{0};
    return std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
  }

 private:
  static constexpr clockid_t kNone = 0;  // that of the wall
  std::atomic<clockid_t> clock_{kNone};
};

/// The task on which code runs that is not in its place in the system, as a constructor or destructor of an exchange, with a limit of
/// its own. Code that hangs is left behind by whoever has begun it.
///
/// Thread contract: one task; start_clock() on the thread that is to be judged.
class CandidateTask {
 public:
  explicit CandidateTask(RunContext& run) : run_(run) {}

  /// Begins something that may take so long, on whichever thread.
  void enter(Duration limit);
  /// Begins something on a task of its own, which wakes the run when it is done.
  void begin(Duration limit, std::function<void()> body);
  /// Judges the calling thread, which is no task of the candidate's own.
  void start_clock();
  /// Forgets the task. @pre  is_done().
  void reset() { task_.reset(); }

  [[nodiscard]] bool is_done() const { return is_done_.load(std::memory_order_acquire); }
  [[nodiscard]] TimePoint limit() const { return limit_; }
  [[nodiscard]] bool is_late() const { return run_.executive.now() >= limit_; }
  /// Returns whether the thread has not slept: it has taken processor time since enter() or begin().
  [[nodiscard]] bool computes() const;
  /// Returns whether there is no task any more at the deadline.
  [[nodiscard]] bool join_until(TimePoint deadline) {
    return task_ == nullptr || task_->join_until(deadline);
  }

 private:
  RunContext& run_;
  CandidateClock clock_;
  std::atomic<bool> is_done_{false};
  std::unique_ptr<Task> task_;
  TimePoint limit_{};
  Duration computed_{};  // by the thread before
};

}  // namespace orca::host
