// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>

namespace orca::host {

/// A request to stop, made by SIGINT or SIGTERM. A second signal ends the process after 0.4 s, whatever it is
/// doing.
///
/// Thread contract: construct before any other thread exists, so that all inherit the blocked signals;
/// requested() and on_request() from anywhere.
class StopSignal {
 public:
  /// @param exit_status  status of a process that the second signal ends.
  explicit StopSignal(int exit_status);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  [[nodiscard]] bool requested() const { return requested_.load(std::memory_order_acquire); }

  /// Calls `action` when the stop is requested, or at once if it has been already; null: no action any more.
  void on_request(std::function<void()> action);

 private:
  void watch();

  std::atomic<bool> requested_{false};
  std::mutex mutex_;
  std::function<void()> action_;
  const int exit_status_;
  int wake_fd_;
  int signal_fd_;
  std::thread watcher_;
};

}  // namespace orca::host
