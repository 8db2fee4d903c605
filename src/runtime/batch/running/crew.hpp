// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include "making/process.hpp"
#include "orca/batch/batch.hpp"
#include "stop_requests.hpp"

namespace orca::batch {

/// A run to be made.
struct Task {
  std::size_t number;      ///< The run's.
  bool elsewhere = false;  ///< In other circumstances, which must change nothing.
  unsigned tries = 0;      ///< So far, in which the machine was overloaded.
};

/// A number of processes that make runs at the same time. A run that the overloaded machine did not let end is made again.
///
/// Thread contract: the main thread, while there is no other.
class Crew {
 public:
  static constexpr unsigned kMostTries = 3;

  /// @param listener  hears of overloads and is called a few times a second.
  Crew(const Experiment& experiment, const BatchOptions& options, BatchListener& listener,
       const StopRequests& requests)
      : experiment_(experiment), options_(options), listener_(listener), requests_(requests) {}

  using Next = std::function<std::optional<Task>()>;
  using Take = std::function<Status(const Task&, const Outcome&, const Cost&)>;
  /// Makes all runs that `next` hands out, and hands each outcome to `take`.
  /// @return whether it came to the end; false: a stop was requested.
  /// @errors  those of `take`; unavailable if no process can be started.
  Result<bool> make(const Next& next, const Take& take);

  /// Returns how many runs were given up because of overloads.
  [[nodiscard]] std::size_t left_out() const { return left_out_; }

 private:
  struct Running {
    Task task;
    RunProcess process;
    bool has_ended = false;
  };

  [[nodiscard]] std::optional<Task> take_next(const Next& next);
  Status start_some(const Next& next);
  bool wait();
  Status take_finished(const Take& take);
  Status conclude(Running& one, RunProcess::Lateness lateness, const Take& take);
  void lose(Task task, const char* why);

  const Experiment& experiment_;
  const BatchOptions& options_;
  BatchListener& listener_;
  const StopRequests& requests_;
  std::vector<Running> running_;
  std::deque<Task> again_;  // after an overload
  std::size_t left_out_ = 0;
};

}  // namespace orca::batch
