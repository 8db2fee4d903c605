// SPDX-License-Identifier: LGPL-3.0-or-later
#include "thread_watch.hpp"

#include <unistd.h>

#include "orca/base/stall_watch.hpp"
#include "orca/base/steady_clock.hpp"

namespace orca::detail {

static thread_local WaitCount* t_current = nullptr;

void WaitCount::attach() {
  t_current = this;
  thread_.store(gettid(), std::memory_order_relaxed);
}

WaitCount* WaitCount::current() { return t_current; }

void ThreadWatch::add(const WaitCount& count) {
  const std::lock_guard lock(mutex_);
  watched_.push_back({.count = &count, .state = count.state(), .since = steady_now()});
}

void ThreadWatch::remove(const WaitCount& count) {
  const std::lock_guard lock(mutex_);
  std::erase_if(watched_, [&](const Watched& watched) { return watched.count == &count; });
}

// Returns for how long a task has not waited for anything of its executive, without the time in which it had no processor. Before the
// second look that is not known, and on an overloaded machine the first two are far apart, so it counts from there.
Duration ThreadWatch::busy_time(Watched& watched, TimePoint now) {
  if (!watched.wait) {
    watched.wait.emplace(getpid(), watched.count->thread());
    watched.waited_before = watched.wait->look();
    watched.since = now;
  }
  return now - watched.since - (watched.wait->look() - watched.waited_before);
}

std::optional<StuckTask> ThreadWatch::stuck_task(Duration limit) {
  const std::lock_guard lock(mutex_);
  const TimePoint now = steady_now();
  const Watched* latest = nullptr;  // only this one has not been reported yet
  for (Watched& watched : watched_) {
    const std::uint64_t state = watched.count->state();
    const bool waits = state % 2 == 1;
    if (waits || !watched.count->is_watched() || state != watched.state) {
      watched.state = state;
      watched.since = now;
      watched.wait.reset();
    } else if (busy_time(watched, now) > limit && (latest == nullptr || watched.since > latest->since)) {
      latest = &watched;
    }
  }
  if (latest == nullptr) return std::nullopt;
  return StuckTask{latest->count->name(), false, false};
}

}  // namespace orca::detail

namespace orca {

void leave_stall_watch() {
  if (detail::WaitCount* const count = detail::WaitCount::current()) count->leave_watch();
}

}  // namespace orca
