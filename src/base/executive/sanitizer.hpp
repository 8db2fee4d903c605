// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#endif

namespace orca::detail {

struct StackBounds {
  const void* bottom = nullptr;
  std::size_t size = 0;
};

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

/// Announces that the stack is gone. Whatever the loader maps there next, for example a plugin, then has no
/// red zones of former frames.
inline void forget_stack([[maybe_unused]] const StackBounds& stack) {
#if defined(__SANITIZE_ADDRESS__)
  __asan_unpoison_memory_region(stack.bottom, stack.size);
#endif
}

}  // namespace orca::detail
