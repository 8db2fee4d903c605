// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/base/system/processor_wait.hpp"
#include "orca/batch/record.hpp"

namespace orca::batch {

/// A process that makes one run. It dies with this one, and when it is destroyed.
///
/// Thread contract: one thread, which is that of all processes of a batch.
class RunProcess {
 public:
  using Clock = std::chrono::steady_clock;

  /// Forks the process.
  /// @param work   is called in it with the descriptor for its outcome, and does not return.
  /// @param limit  [s] after which it is killed.
  /// @errors  unavailable, with the reason.
  static Result<RunProcess> start(const std::function<void(int)>& work, double limit);

  RunProcess(RunProcess&& other) noexcept;
  RunProcess& operator=(RunProcess&& other) noexcept;
  ~RunProcess();

  /// The descriptor that becomes readable when there is news.
  [[nodiscard]] int descriptor() const { return from_; }

  /// Reads what there is. Returns whether that was all.
  [[nodiscard]] bool read();

  /// The kinds of lateness.
  enum class Lateness {
    none,
    hang,     ///< It had the whole limit for itself.
    overload  ///< It has waited for a processor for longer than the limit, and for at least 5 s.
  };
  /// Compares its time with the limit. Time in which it waits for a processor does not count, so that the load of the machine
  /// makes no hang. Call it several times a second, because it also looks whether the process gets on between two calls.
  [[nodiscard]] Lateness lateness();

  /// Kills it.
  void kill_late(Cost& cost);
  /// Waits for its end, after read() has returned true.
  [[nodiscard]] Outcome outcome(Cost& cost);
  /// Returns whether somebody else has killed it, such as a machine without memory. @pre  outcome() was called.
  [[nodiscard]] bool was_killed() const { return was_killed_; }

 private:
  RunProcess(pid_t pid, int from, double limit) : pid_(pid), from_(from), limit_(limit) {}
  int wait(Cost& cost);  // Returns its status.

  pid_t pid_;     // 0: it has gone
  int from_;      // -1: closed
  double limit_;  // [s]
  Clock::time_point started_ = Clock::now();
  ProcessorWait wait_{pid_};
  bool was_killed_ = false;
  std::string text_;
};

}  // namespace orca::batch
