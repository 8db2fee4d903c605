// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/stop_signal.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/base/live_line.hpp"
#include "orca/base/system/signal_name.hpp"
#include "orca/host/last_words.hpp"

namespace orca::host {
namespace {

using namespace std::chrono_literals;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::chrono::milliseconds kEndLimit = 30s;  // everything takes longer, most of all the end
#else
constexpr std::chrono::milliseconds kEndLimit = 2500ms;
#endif
constexpr std::chrono::milliseconds kHostEndLimit = kEndLimit / 6;
constexpr std::chrono::milliseconds kSecondSignalGrace = 400ms;
constexpr std::chrono::milliseconds kMotorLimit = 300ms;

constexpr std::array kRequests{SIGINT, SIGTERM, SIGHUP, SIGQUIT};
// SIGPIPE and SIGXFSZ are not among them: the program ignores them.
constexpr std::array kOthers{SIGALRM, SIGUSR1, SIGUSR2,   SIGVTALRM, SIGPROF,
                             SIGIO,   SIGPWR,  SIGSTKFLT, SIGXCPU};

// What a signal handler needs.
std::atomic<int> g_wake_fd{-1};
std::atomic<pid_t> g_process{0};
std::atomic<int> g_signal{0};  // the first that was none of the requests
std::atomic<bool> g_pending{false};
std::atomic<bool> g_crashing{false};
std::atomic<bool> g_crash_handled{false};
std::atomic<bool> g_has_motors{false};

void wake_watcher() noexcept {
  const std::uint64_t one = 1;
  // It cannot fail: the counter is not full.
  [[maybe_unused]] const ssize_t written = write(g_wake_fd.load(), &one, sizeof one);
}

void on_other_signal(int signal) {
  const int kept = errno;
  if (getpid() != g_process.load()) {  // a copy of the process, which dies of it as any other does
    ::signal(signal, SIG_DFL);
    raise(signal);
  } else {
    int none = 0;
    g_signal.compare_exchange_strong(none, signal);
    g_pending.store(true);
    wake_watcher();
  }
  errno = kept;
}

bool would_end_process(int signal) {
  struct sigaction present {};
  return sigaction(signal, nullptr, &present) == 0 && (present.sa_flags & SA_SIGINFO) == 0 &&
         present.sa_handler == SIG_DFL;
}

}  // namespace

StopSignal::StopSignal(int stopped_status, int failed_status, Terminal terminal)
    : stopped_status_(stopped_status), failed_status_(failed_status), terminal_(terminal) {
  g_wake_fd.store(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (g_wake_fd.load() < 0) throw_if_exhausted(errno);
  g_process.store(getpid());
  g_signal.store(0);
  block_requests();
  handle_others();
  watcher_ = std::thread([this] { watch(); });
}

StopSignal::~StopSignal() {
  ending_.store(true);
  wake_watcher();
  watcher_.join();
  close(signal_fd_);
  close(g_wake_fd.exchange(-1));
}

void StopSignal::block_requests() {
  sigset_t set;
  sigemptyset(&set);
  const bool heeded = terminal_ == Terminal::heeded;
  for (const int signal : kRequests)
    if (signal == SIGTERM || (heeded && (signal == SIGINT || would_end_process(signal))))
      sigaddset(&set, signal);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  signal_fd_ = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
  if (signal_fd_ < 0) throw_if_exhausted(errno);
}

// These are handled instead of blocked, so that a library that handles one itself takes it over.
void StopSignal::handle_others() {
  struct sigaction action {};
  action.sa_handler = on_other_signal;
  action.sa_flags = SA_RESTART | SA_ONSTACK;
  for (const int signal : kOthers)
    if (would_end_process(signal)) sigaction(signal, &action, nullptr);
  for (int signal = SIGRTMIN; signal < SIGRTMAX; ++signal)
    if (would_end_process(signal)) sigaction(signal, &action, nullptr);
}

std::string StopSignal::failure() const { return name_of(g_signal.load()); }

std::string StopSignal::name_of(int signal) {
  return signal == 0 ? std::string() : "SIG" + signal_name(signal);
}

void StopSignal::on_request(std::function<void()> action) {
  const std::lock_guard lock(mutex_);
  action_ = std::move(action);
  if (action_) has_run_.store(true);
  if (action_ && requested()) action_();
}

void StopSignal::on_crash(std::function<void()> action) {
  const std::lock_guard lock(mutex_);
  crash_action_ = std::move(action);
  g_has_motors.store(crash_action_ != nullptr);
}

void StopSignal::stop_motors() noexcept {
  if (!g_has_motors.load() || getpid() != g_process.load()) return;
  if (!g_crashing.exchange(true)) wake_watcher();
  const timespec moment{0, 1'000'000};
  for (auto waited = 0ms; waited < kMotorLimit && !g_crash_handled.load(); waited += 1ms)
    nanosleep(&moment, nullptr);
}

void StopSignal::watch() {
  for (;;) {
    switch (next()) {
      case Wake::end: return;
      case Wake::crash: prepare_for_death(); break;
      case Wake::signal: request(); break;
      case Wake::timeout: give_up();
    }
  }
}

// Waits for whatever comes next.
StopSignal::Wake StopSignal::next() {
  for (;;) {
    if (ending_.load()) return Wake::end;
    if (g_crashing.load() && !g_crash_handled.load()) return Wake::crash;
    signalfd_siginfo info;
    sender_ = 0;
    if (g_pending.exchange(false)) return Wake::signal;
    if (read(signal_fd_, &info, sizeof info) == sizeof info) {
      sender_ = static_cast<pid_t>(info.ssi_pid);
      return Wake::signal;
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now());
    if (left <= 0ms) return Wake::timeout;
    pollfd fds[] = {{signal_fd_, POLLIN, 0}, {g_wake_fd.load(), POLLIN, 0}};
    poll(fds, 2, deadline_ == Clock::time_point::max() ? -1 : static_cast<int>(left.count()));
    std::uint64_t count = 0;
    [[maybe_unused]] const ssize_t emptied = read(g_wake_fd.load(), &count, sizeof count);
  }
}

void StopSignal::request() {
  if (requested_.exchange(true)) {
    if (!urgent_.exchange(true)) deadline_ = std::min(deadline_, Clock::now() + kSecondSignalGrace);
    return;
  }
  // The supervisor has waited already; whoever signals all processes at once has not, and it sees to their end.
  const bool is_late = is_host_process() && sender_ == getppid();
  deadline_ = Clock::now() + (is_late ? kHostEndLimit : kEndLimit);
  const std::lock_guard lock(mutex_);
  if (action_) action_();
}

void StopSignal::prepare_for_death() {
  {
    // The thread that crashed may hold the lock; then nothing can be done.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock() && crash_action_) crash_action_();
  }
  g_crash_handled.store(true);
}

void StopSignal::give_up() {
  const int status = has_run_.load() ? failed_status_ : stopped_status_;
  LiveLine::erase_for_good();
  if (urgent_.load()) std::_Exit(stopped_status_);
  LastWords::end_hung(main_thread_,
                      is_host_process()
                          ? "has not ended in time; the process is ended without it"
                          : "has not ended 2.5 s after the signal to stop; the process is ended without it",
                      status);
}

}  // namespace orca::host
