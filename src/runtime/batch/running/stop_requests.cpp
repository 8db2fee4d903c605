// SPDX-License-Identifier: LGPL-3.0-or-later
#include "stop_requests.hpp"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

namespace orca::batch {

StopRequests::StopRequests() {
  sigset_t wanted;
  sigemptyset(&wanted);
  sigaddset(&wanted, SIGINT);
  sigaddset(&wanted, SIGTERM);
  sigprocmask(SIG_BLOCK, &wanted, &before_);
  descriptor_ = signalfd(-1, &wanted, SFD_CLOEXEC | SFD_NONBLOCK);
}

StopRequests::~StopRequests() {
  signalfd_siginfo taken{};
  while (::read(descriptor_, &taken, sizeof taken) > 0) continue;
  close(descriptor_);
  sigprocmask(SIG_SETMASK, &before_, nullptr);
}

bool StopRequests::any() const {
  pollfd news{descriptor_, POLLIN, 0};
  return poll(&news, 1, 0) > 0;
}

}  // namespace orca::batch
