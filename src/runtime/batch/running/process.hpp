// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "orca/base/result.hpp"
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
  static Result<RunProcess> start(std::size_t run, const std::function<void(int)>& work, double limit);

  RunProcess(RunProcess&& other) noexcept;
  RunProcess& operator=(RunProcess&& other) noexcept;
  ~RunProcess();

  [[nodiscard]] std::size_t run() const { return run_; }
  /// The descriptor that becomes readable when there is news.
  [[nodiscard]] int descriptor() const { return from_; }
  [[nodiscard]] Clock::time_point deadline() const { return deadline_; }

  /// Reads what there is. Returns whether that was all.
  [[nodiscard]] bool read();
  /// Kills it, because it is late.
  [[nodiscard]] Outcome kill_late(Cost& cost);
  /// Waits for its end, after read() has returned true.
  [[nodiscard]] Outcome outcome(Cost& cost);

 private:
  RunProcess(std::size_t run, pid_t pid, int from, Clock::time_point deadline)
      : run_(run), pid_(pid), from_(from), deadline_(deadline) {}
  int wait(Cost& cost);  // Returns its status.

  std::size_t run_;
  pid_t pid_;  // 0: it has gone
  int from_;   // -1: closed
  Clock::time_point deadline_;
  Clock::time_point started_ = Clock::now();
  std::string text_;
};

}  // namespace orca::batch
