// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <pthread.h>

#include <atomic>

#include "orca/base/time.hpp"

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

}  // namespace orca::host
