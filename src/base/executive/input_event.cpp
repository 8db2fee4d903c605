// SPDX-License-Identifier: LGPL-3.0-or-later
#include "input_event.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <system_error>

#include "orca/base/steady_clock.hpp"
#include "sanitizer.hpp"
#include "thread_watch.hpp"

namespace orca::detail {
namespace {

// As those of FutexEvent: only the waiter sets kAsleep.
enum InputState : std::uint32_t { kNoNews, kNews, kPolling };

timespec time_left(TimePoint deadline) {
  const auto left = std::max(deadline - steady_now(), Duration{0});
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  return {seconds.count(), (left - seconds).count()};
}

}  // namespace

ThreadInputEvent::ThreadInputEvent() : bell_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (bell_ < 0) throw std::system_error(errno, std::generic_category(), "no event for input");
}

ThreadInputEvent::~ThreadInputEvent() { close(bell_); }

void ThreadInputEvent::notify() {
  if (state_.exchange(kNews, std::memory_order_acq_rel) != kPolling) return;
  const std::uint64_t one = 1;
  (void)!write(bell_, &one, sizeof one);
}

bool ThreadInputEvent::wait_until(TimePoint deadline) {
  const Waiting waiting;
  if (take()) return true;
  for (;;) {
    std::uint32_t seen = kNoNews;
    if (!state_.compare_exchange_strong(seen, kPolling, std::memory_order_acq_rel)) return take();
    const bool has_input = poll_until(deadline);
    const bool notified = state_.exchange(kNoNews, std::memory_order_acq_rel) == kNews;
    if (notified || has_input) return true;
    if (deadline != kForever && steady_now() >= deadline) return false;
  }
}

bool ThreadInputEvent::take() {
  return state_.load(std::memory_order_relaxed) == kNews &&
         state_.exchange(kNoNews, std::memory_order_acquire) == kNews;
}

// Sleeps until there is news or the deadline comes, or for a shorter time: a ring may come late, when what it told of is known
// already. Returns whether the descriptor has input, or has failed, which reading it tells.
bool ThreadInputEvent::poll_until(TimePoint deadline) {
  if constexpr (kLongestSleep != Duration::max()) deadline = std::min(deadline, steady_now() + kLongestSleep);
  pollfd news[] = {{bell_, POLLIN, 0}, {watched_, POLLIN, 0}};  // a negative one is left out
  const timespec left = deadline == kForever ? timespec{} : time_left(deadline);
  const int count = ppoll(news, 2, deadline == kForever ? nullptr : &left, nullptr);
  let_signals_be_handled();
  if (count <= 0) return false;
  if (news[0].revents != 0) drain();
  return news[1].revents != 0;
}

void ThreadInputEvent::drain() {
  std::uint64_t rings = 0;
  (void)!read(bell_, &rings, sizeof rings);
}

}  // namespace orca::detail
