// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <mutex>

namespace orca::host {

/// Takes the mutex unless somebody holds it until the limit is over. A std::timed_mutex would do it too, but the
/// thread sanitizer of GCC 12 does not see that it is taken (no interceptor for pthread_mutex_clocklock).
[[nodiscard]] std::unique_lock<std::mutex> lock_before(std::chrono::steady_clock::time_point limit,
                                                       std::mutex& mutex);

}  // namespace orca::host
