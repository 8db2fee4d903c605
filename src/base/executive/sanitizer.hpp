// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <unistd.h>

#include <cstddef>

#include "orca/base/time.hpp"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#endif

namespace orca::detail {

struct StackBounds {
  const void* bottom = nullptr;
  std::size_t size = 0;
};

/// The longest time for which a thread may sleep in a system call of our own before it lets signals be handled.
#if defined(__SANITIZE_THREAD__)
inline constexpr Duration kLongestSleep = std::chrono::milliseconds(50);
#else
inline constexpr Duration kLongestSleep = Duration::max();
#endif

/// Lets ThreadSanitizer run the handlers of signals that came during a system call of our own. It keeps them back
/// until the thread calls something that it knows. Does nothing in other builds.
inline void let_signals_be_handled() {
#if defined(__SANITIZE_THREAD__)
  usleep(0);
#endif
}

/// Announce to AddressSanitizer that the stack is about to change, and that it has changed. They do nothing
/// in other builds.
inline void start_switch([[maybe_unused]] void** fake_stack, [[maybe_unused]] const StackBounds& to) {
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_start_switch_fiber(fake_stack, to.bottom, to.size);
#endif
}

inline void finish_switch([[maybe_unused]] void* fake_stack, [[maybe_unused]] StackBounds* from) {
#if defined(__SANITIZE_ADDRESS__)
  StackBounds unused;
  StackBounds& bounds = from != nullptr ? *from : unused;
  __sanitizer_finish_switch_fiber(fake_stack, &bounds.bottom, &bounds.size);
#endif
}

/// Announces that the stack is gone. The next mapping there, for example of a plugin, then
/// has no red zones of former frames.
inline void forget_stack([[maybe_unused]] const StackBounds& stack) {
#if defined(__SANITIZE_ADDRESS__)
  __asan_unpoison_memory_region(stack.bottom, stack.size);
#endif
}

}  // namespace orca::detail
