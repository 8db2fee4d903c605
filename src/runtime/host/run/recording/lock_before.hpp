// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <mutex>
#include <thread>

namespace orca::host {

/// Takes the mutex unless somebody holds it until the limit is over. A std::timed_mutex would do it too, but the
/// thread sanitizer of GCC 12 does not see that it is taken (no interceptor for pthread_mutex_clocklock).
[[nodiscard]] inline std::unique_lock<std::mutex> lock_before(std::chrono::steady_clock::time_point limit,
                                                              std::mutex& mutex) {
  std::unique_lock lock(mutex, std::try_to_lock);
  while (!lock.owns_lock() && std::chrono::steady_clock::now() < limit) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lock.try_lock();
  }
  return lock;
}

}  // namespace orca::host
