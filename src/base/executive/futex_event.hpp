// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

#include "orca/base/executive.hpp"

namespace orca::detail {

/// An Event between threads: one word, and a system call only where a thread sleeps or must be woken.
///
/// Before it sleeps the waiting thread spins for a while, because waking a thread on a halted core takes much
/// longer than what it often waits for. How long adapts itself: spinning pays only where waits end within
/// about the limit.
///
/// Thread contract: as Event.
class FutexEvent final : public Event {
 public:
  /// @param spin_limit  longest time to spin before sleeping; 0: never spin.
  explicit FutexEvent(Duration spin_limit) : spin_limit_(spin_limit), spin_(spin_limit) {}

  void notify() override;
  bool wait_until(TimePoint deadline) override;

 private:
  // The waiter alone goes to asleep and leaves it on timeout; a notification is the only way out otherwise,
  // so none is lost.
  enum State : std::uint32_t { kIdle, kNotified, kAsleep };

  bool take();
  bool spin_then_sleep(TimePoint deadline);
  bool spin(TimePoint until);
  bool sleep(TimePoint deadline);

  std::atomic<std::uint32_t> state_{kIdle};
  const Duration spin_limit_;
  Duration spin_;  // waiter only: how long it spins at present
};

/// The limit, or 0 where this process may use only one processor: there spinning keeps away whom it waits
/// for.
[[nodiscard]] Duration useful_spin(Duration limit);

}  // namespace orca::detail
