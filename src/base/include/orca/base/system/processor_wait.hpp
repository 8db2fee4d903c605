// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>

#include "orca/base/time.hpp"

namespace orca {

/// The time for which threads could run and no processor was free for them. It separates one that computes, or hangs, from one
/// that the machine has no time for. The system itself counts a wait only when it ends, so whoever wants to know of one that
/// goes on looks now and then. Where the system reports nothing the wait is 0.
///
/// Thread contract: not synchronised.
class ProcessorWait {
 public:
  /// @param process  whose threads count.
  /// @param thread   only this one of them; nothing: all together.
  explicit ProcessorWait(pid_t process, std::optional<pid_t> thread = std::nullopt)
      : process_(process), thread_(thread) {}

  /// Returns the wait [s] from the beginning of the threads until now. It never becomes less.
  Duration look();

 private:
  using Clock = std::chrono::steady_clock;

  pid_t process_;
  std::optional<pid_t> thread_;
  Duration ran_{0};                            // at the last look
  Clock::time_point last_ran_ = Clock::now();  // or could not run, as far as looks have seen it
  Duration waited_{0};
};

/// Returns the thread of a process that has a certain name, as pthread_setname_np() sets it; nothing: there is none.
[[nodiscard]] std::optional<pid_t> find_thread(pid_t process, const char* name);

}  // namespace orca
