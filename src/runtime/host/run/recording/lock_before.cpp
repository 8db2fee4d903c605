// SPDX-License-Identifier: LGPL-3.0-or-later
#include "lock_before.hpp"

#include <thread>

namespace orca::host {
namespace {

constexpr std::chrono::milliseconds kRetry{1};

}  // namespace

std::unique_lock<std::mutex> lock_before(std::chrono::steady_clock::time_point limit, std::mutex& mutex) {
  std::unique_lock lock(mutex, std::try_to_lock);
  while (!lock.owns_lock() && std::chrono::steady_clock::now() < limit) {
    std::this_thread::sleep_for(kRetry);
    lock.try_lock();
  }
  return lock;
}

}  // namespace orca::host
