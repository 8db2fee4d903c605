// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace orca::host {

/// The way in which signals end this process: robot first, then everything else, within 3 s.
///
/// SIGINT, SIGTERM, SIGHUP and SIGQUIT are requests to stop. All other signals that would end a process at once
/// request it too, unless a library handles them, but are a failure(). Signals that the process was started to
/// ignore stay ignored, except SIGINT and SIGTERM. A process that has not ended by itself 2.5 s after the first
/// signal is ended, after a line that says what it is doing. A second signal ends it after 0.4 s. A host process, which is
/// terminated only after it was asked to end, has 0.4 s from the first signal.
///
/// A crash cannot be survived, but the motors are stopped before: see on_crash().
///
/// Thread contract: one object at a time, made before any other thread exists, so that all inherit the blocked
/// signals. It may live until the process has ended, so that destructors and atexit handlers cannot hang. Members
/// from anywhere.
class StopSignal {
 public:
  /// Who decides about signals that a terminal sends to all processes that it started.
  enum class Terminal {
    heeded,   ///< They are requests as any other.
    ignored,  ///< Another process of the group decides; SIGTERM alone is a request.
  };

  /// @param stopped_status  status of a process that is ended when nothing runs yet, or by the second signal.
  /// @param failed_status   status of a process that does not end by itself.
  /// @errors  throws std::system_error if there is no descriptor or thread left.
  explicit StopSignal(int stopped_status, int failed_status = EXIT_FAILURE,
                      Terminal terminal = Terminal::heeded);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  [[nodiscard]] bool requested() const { return requested_.load(std::memory_order_acquire); }

  /// Returns whether a second signal has come: whoever waits wants no more than the motors to be stopped.
  [[nodiscard]] bool is_urgent() const { return urgent_.load(std::memory_order_acquire); }

  /// Returns the name of the signal that requested the stop, if it is not one for that purpose: "SIGUSR1". Empty
  /// otherwise.
  [[nodiscard]] std::string failure() const;

  /// Calls `action` when the stop is requested, or at once if it has been already; null: no action any more.
  void on_request(std::function<void()> action);

  /// Calls `action` on a thread of its own when this process is about to die of a crash; null: no action any
  /// more. The process waits 0.3 s for it at most.
  void on_crash(std::function<void()> action);

  /// Waits until the motors are stopped, as far as possible: to be called by whatever is about to end the process
  /// at once.
  /// @thread  any; also in a signal handler.
  static void stop_motors() noexcept;

 private:
  enum class Wake { signal, crash, end, timeout };
  using Clock = std::chrono::steady_clock;

  void block_requests();
  void handle_others();
  void watch();
  [[nodiscard]] Wake next();
  void request();
  void prepare_for_death();
  [[noreturn]] void give_up();
  [[nodiscard]] bool is_host_process() const { return terminal_ == Terminal::ignored; }
  [[nodiscard]] static std::string name_of(int signal);

  const int stopped_status_;
  const int failed_status_;
  const Terminal terminal_;
  const pthread_t main_thread_ = pthread_self();
  std::atomic<bool> requested_{false};
  std::atomic<bool> urgent_{false};  // a second signal has come
  std::atomic<bool> ending_{false};
  std::atomic<bool> has_run_{false};  // there was something to take down
  std::mutex mutex_;
  std::function<void()> action_;
  std::function<void()> crash_action_;
  // Used by the watcher only.
  Clock::time_point deadline_ = Clock::time_point::max();
  pid_t sender_ = 0;  // of the last request; 0: not known
  int signal_fd_ = -1;
  std::thread watcher_;
};

}  // namespace orca::host
