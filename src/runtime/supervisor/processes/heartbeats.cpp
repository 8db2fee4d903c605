// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/heartbeats.hpp"

#include <algorithm>

namespace orca::supervisor {

// A hang is found within its limit and one step.
Duration Heartbeats::step_of(const Watched& process) { return process.limit / 10; }

void Heartbeats::watch(std::size_t process, Duration limit) {
  page_.heartbeat(process).store(0, std::memory_order_relaxed);
  watched_.at(process) = Watched{.limit = limit};
}

void Heartbeats::watch_working(std::size_t process, Duration limit) {
  page_.heartbeat(process).store(1, std::memory_order_relaxed);
  watched_.at(process) = Watched{.limit = limit};
}

void Heartbeats::forget(std::size_t process) { watched_.at(process).reset(); }

std::vector<std::size_t> Heartbeats::look(Moment now) {
  std::vector<std::size_t> hung;
  const Duration since_last = now - last_look_;
  last_look_ = now;
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    if (!watched_[i]) continue;
    Watched& process = *watched_[i];
    const std::uint32_t beats = page_.heartbeat(i).load(std::memory_order_relaxed);
    if (beats != process.seen || beats == 0) {
      process.seen = beats;
      process.silent = Duration{0};
    } else {
      process.silent += std::min(since_last, step_of(process));
      if (process.silent >= process.limit) hung.push_back(i);
    }
  }
  for (const std::size_t process : hung) forget(process);
  return hung;
}

std::optional<Moment> Heartbeats::due() const {
  std::optional<Moment> next;
  for (const auto& process : watched_)
    if (process) next = std::min(next.value_or(Moment::max()), last_look_ + step_of(*process));
  return next;
}

}  // namespace orca::supervisor
