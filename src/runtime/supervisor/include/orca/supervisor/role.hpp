// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::supervisor {

/// What somebody may do at a system's socket; each includes those before it.
enum class Access {
  none,
  observe,  ///< Look.
  operate,  ///< Steer what runs: goals, tasks, pauses, the emergency stop.
  change,   ///< Exchange what runs, or end it.
};
/// @thread  any.
[[nodiscard]] const char* to_string(Access access);

}  // namespace orca::supervisor
