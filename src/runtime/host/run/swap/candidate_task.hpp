// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "candidate_clock.hpp"
#include "orca/base/executive.hpp"
#include "orca/base/time.hpp"
#include "run/reporting/run_context.hpp"

namespace orca::host {

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
