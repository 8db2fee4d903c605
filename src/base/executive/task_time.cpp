// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/system/task_time.hpp"

#include <atomic>
#include <ctime>

#include "turn_time.hpp"

namespace orca {
namespace {

std::atomic<bool> g_apart{false};

// The fiber whose turn it is on this thread, or null.
[[gnu::tls_model("initial-exec")]] thread_local detail::FiberTime* t_fiber = nullptr;

Duration thread_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

}  // namespace

Duration task_time() {
  const Duration now = thread_time();
  return t_fiber == nullptr ? now : t_fiber->used + (now - t_fiber->turn_began);
}

void tell_tasks_apart() { g_apart.store(true, std::memory_order_relaxed); }

bool detail::tells_tasks_apart() { return g_apart.load(std::memory_order_relaxed); }

void detail::begin_turn(FiberTime& fiber) {
  fiber.turn_began = thread_time();
  t_fiber = &fiber;
}

void detail::end_turn() {
  t_fiber->used += thread_time() - t_fiber->turn_began;
  t_fiber = nullptr;
}

}  // namespace orca
