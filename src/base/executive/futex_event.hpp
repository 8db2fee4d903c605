// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "orca/base/doorbell.hpp"
#include "orca/base/executive.hpp"

namespace orca::detail {

/// An Event between threads, also of several processes. It is one word, and makes a system call only when a thread sleeps or must be
/// woken.
///
/// The waiting thread spins for a while before it sleeps, because to wake a thread on a halted core often
/// takes much longer than the wait itself. The time adapts itself: spinning pays only where waits end within
/// about the limit.
///
/// Thread contract: as Event.
class FutexEvent final : public Event {
 public:
  /// @param spin_limit  longest time to spin before sleeping [s]; 0: never spin.
  /// @param doorbell    a word shared with other processes, which outlives the event; null: a word of its own.
  explicit FutexEvent(Duration spin_limit, DoorbellWord* doorbell = nullptr);

  void notify() override;
  bool wait_until(TimePoint deadline) override;

  /// Clears the flag without waiting. Serves the waiter.
  /// @return whether it was set.
  bool take();

 private:
  bool spin_then_sleep(TimePoint deadline);
  bool spin(TimePoint until);
  bool sleep(TimePoint deadline);

  DoorbellWord own_;
  DoorbellWord& state_;
  const int scope_;  // of the futex: this process, or all
  const Duration spin_limit_;
  Duration spin_;  // used by the waiter only: how long it spins at present
};

/// Returns the limit, or 0 if this process may use only one processor: there a spinning thread keeps the one
/// it waits for from running.
[[nodiscard]] Duration useful_spin(Duration limit);

}  // namespace orca::detail
