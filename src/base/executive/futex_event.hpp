// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

#include "orca/base/executive.hpp"

namespace orca::detail {

/// An Event between threads. It is one word, and makes a system call only when a thread sleeps or must be
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
  explicit FutexEvent(Duration spin_limit) : spin_limit_(spin_limit), spin_(spin_limit) {}

  void notify() override;
  bool wait_until(TimePoint deadline) override;

 private:
  // Only the waiter sets kAsleep, and only the waiter leaves it at a timeout. Any other way out is a
  // notification, so none is lost.
  enum State : std::uint32_t { kIdle, kNotified, kAsleep };

  bool take();
  bool spin_then_sleep(TimePoint deadline);
  bool spin(TimePoint until);
  bool sleep(TimePoint deadline);

  std::atomic<std::uint32_t> state_{kIdle};
  const Duration spin_limit_;
  Duration spin_;  // used by the waiter only: how long it spins at present
};

/// Returns the limit, or 0 if this process may use only one processor: there a spinning thread keeps the one
/// it waits for from running.
[[nodiscard]] Duration useful_spin(Duration limit);

}  // namespace orca::detail
