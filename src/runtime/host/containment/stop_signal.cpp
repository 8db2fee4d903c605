// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/stop_signal.hpp"

#include <poll.h>
#include <signal.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <utility>

namespace orca::host {
namespace {

sigset_t stop_signals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

constexpr int kSecondSignalGraceMs = 400;

}  // namespace

StopSignal::StopSignal(int exit_status) : exit_status_(exit_status), wake_fd_(eventfd(0, EFD_CLOEXEC)) {
  const sigset_t set = stop_signals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  signal_fd_ = signalfd(-1, &set, SFD_CLOEXEC);
  watcher_ = std::thread([this] { watch(); });
}

StopSignal::~StopSignal() {
  const std::uint64_t one = 1;
  if (write(wake_fd_, &one, sizeof one) == sizeof one) watcher_.join();
  close(signal_fd_);
  close(wake_fd_);
}

void StopSignal::on_request(std::function<void()> action) {
  const std::lock_guard lock(mutex_);
  action_ = std::move(action);
  if (action_ && requested()) action_();
}

void StopSignal::watch() {
  pollfd fds[] = {{signal_fd_, POLLIN, 0}, {wake_fd_, POLLIN, 0}};
  while (poll(fds, 2, -1) >= 0 && (fds[1].revents & POLLIN) == 0) {
    signalfd_siginfo info;
    if (read(signal_fd_, &info, sizeof info) != sizeof info) continue;
    if (requested_.exchange(true)) {
      // After a second signal the process gets a short time to end by itself. Then it is ended.
      if (poll(fds + 1, 1, kSecondSignalGraceMs) == 0) std::_Exit(exit_status_);
      return;
    }
    const std::lock_guard lock(mutex_);
    if (action_) action_();
  }
}

}  // namespace orca::host
