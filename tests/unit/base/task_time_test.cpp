// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/system/task_time.hpp"

#include <catch2/catch.hpp>

#include "executive_kinds.hpp"

using namespace orca;
using namespace orca::test;

namespace {

// Uses the processor for a while, and returns what the task used meanwhile.
Duration burn(Duration time) {
  const Duration begin = task_time();
  while (task_time() - begin < time) {
  }
  return task_time() - begin;
}

}  // namespace

TEST_CASE("a task's processor time is its own, whatever others use while it waits",
          "[executive][task_time]") {
  tell_tasks_apart();
  on_all([](Executive& executive) {
    Duration waited{0};
    Duration burnt{0};
    const TimePoint start = executive.now();
    const auto other = executive.spawn({"other", 0}, [&] {
      executive.sleep_until(start + 20ms);
      burnt = burn(30ms);
    });
    const auto waiter = executive.spawn({"waiter", 0}, [&] {
      const Duration begin = task_time();
      executive.sleep_until(start + 10ms);
      executive.sleep_until(start + 200ms);
      waited = task_time() - begin;
    });
    CHECK(waiter->join_until(kForever));
    CHECK(other->join_until(kForever));
    CHECK(burnt >= 30ms);
    CHECK(waited >= 0ms);
    CHECK(waited < 15ms);
  });
}
