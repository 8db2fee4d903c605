// SPDX-License-Identifier: LGPL-3.0-or-later
#include "poller.hpp"

#include <sys/eventfd.h>

#include <algorithm>
#include <cerrno>

#include "orca/base/exhaustion.hpp"

namespace orca::supervisor {
namespace {

Descriptor make_wake() {
  Descriptor wake(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!wake) throw_if_exhausted(errno);
  return wake;
}

int milliseconds_until(Moment moment) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(moment - Moment::clock::now());
  return static_cast<int>(std::clamp<std::chrono::milliseconds::rep>(left.count(), 0, 60'000));
}

}  // namespace

Poller::Poller() : wake_(make_wake()) {}

void Poller::wait(const Members& members, const std::vector<pollfd>& others, Moment until) {
  std::vector<pollfd> all{{wake_.number(), POLLIN, 0}};
  all.insert(all.end(), others.begin(), others.end());
  for (const Member* const member : members) {
    HostProcess* const process = member->process();
    if (process == nullptr) continue;
    const bool unsent = process->channel().has_unsent();
    const int channel = member->is_deaf() ? -1 : process->channel().descriptor();
    all.push_back({channel, static_cast<short>(unsent ? POLLIN | POLLOUT : POLLIN), 0});
    all.push_back({process->end_descriptor(), POLLIN, 0});
    all.push_back({process->output_descriptor(), POLLIN, 0});
  }
  poll(all.data(), all.size(), milliseconds_until(until));
  eventfd_t count = 0;
  if (all.front().revents != 0) eventfd_read(wake_.number(), &count);
}

void Poller::wake() const { eventfd_write(wake_.number(), 1); }

}  // namespace orca::supervisor
