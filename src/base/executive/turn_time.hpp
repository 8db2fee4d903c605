// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/time.hpp"

namespace orca::detail {

/// The processor time of one fiber, for task_time().
struct FiberTime {
  Duration used{0};        ///< In the turns before this one.
  Duration turn_began{0};  ///< By the thread's clock.
};

/// Returns whether executives are to keep these times.
[[nodiscard]] bool tells_tasks_apart();

/// Report that the thread goes over to a fiber, and that its turn is over. Fibers with threads of their own need neither.
void begin_turn(FiberTime& fiber);
void end_turn();

}  // namespace orca::detail
