// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/time.hpp"

namespace orca {

/// Returns the processor time that the calling task has used so far [s]; only differences of it mean anything. Without
/// tell_tasks_apart() that of other fibers on its thread counts as well.
/// @thread  any.
[[nodiscard]] Duration task_time();

/// Makes task_time() leave out other fibers of the thread, in executives that begin to run from now on. Each turn of a
/// fiber then looks at the thread's clock twice.
/// @thread  any.
void tell_tasks_apart();

}  // namespace orca
