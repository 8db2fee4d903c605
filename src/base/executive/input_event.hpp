// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>

#include "orca/base/executive.hpp"

namespace orca::detail {

/// An InputEvent between threads. It makes a system call only when a thread sleeps or must be woken, and to look at the
/// descriptor.
///
/// Thread contract: as InputEvent.
class ThreadInputEvent final : public InputEvent {
 public:
  /// @errors  throws std::system_error if the system has no more descriptors.
  ThreadInputEvent();
  ~ThreadInputEvent() override;

  void notify() override;
  bool wait_until(TimePoint deadline) override;
  void watch(int descriptor) override { watched_ = descriptor; }

 private:
  bool take();
  bool poll_until(TimePoint deadline);
  void drain();

  std::atomic<std::uint32_t> state_{0};
  const int bell_;    // an eventfd
  int watched_ = -1;  // used by the waiter only
};

}  // namespace orca::detail
