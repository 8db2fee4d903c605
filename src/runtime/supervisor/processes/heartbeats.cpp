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
      note_beat(i, process, beats);
      continue;
    }
    const Duration step = std::min(since_last, step_of(process));
    const Duration starved = starved_of(i, process, step);
    process.starved += starved;
    process.silent += step - starved;
    if (process.silent >= process.limit) hung.push_back(i);
  }
  for (const std::size_t process : hung) forget(process);
  return hung;
}

void Heartbeats::note_beat(std::size_t place, Watched& process, std::uint32_t beats) {
  if (process.starved >= process.limit) starved_.emplace_back(place, process.starved);
  process = Watched{.limit = process.limit, .seen = beats};
}

// Returns how much of the time since the last look a silent process has waited for a processor. The first look at one that has
// just fallen silent only tells how long it had waited before.
Duration Heartbeats::starved_of(std::size_t place, Watched& process, Duration step) const {
  if (!waited_) return Duration{0};
  const Duration waited = waited_(place);
  const Duration before = std::exchange(process.waited, waited).value_or(waited);
  return std::clamp(waited - before, Duration{0}, step);
}

std::vector<std::pair<std::size_t, Duration>> Heartbeats::take_starved() {
  return std::exchange(starved_, {});
}

std::optional<Moment> Heartbeats::due() const {
  std::optional<Moment> next;
  for (const auto& process : watched_)
    if (process) next = std::min(next.value_or(Moment::max()), last_look_ + step_of(*process));
  return next;
}

}  // namespace orca::supervisor
