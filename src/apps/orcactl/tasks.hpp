// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "common/command_line.hpp"
#include "exit_code.hpp"
#include "orca/base/json.hpp"
#include "orca/idl/tasks.hpp"

namespace orca::orcactl {

/// Returns a task for people: a line for each step, with how far it is, indented as the steps are within each other.
[[nodiscard]] std::string tree_text(const idl::TaskState& task);

/// Writes a task for programs, as an object with all its steps in their order; `depth` counts how far a step is within others.
void write_task(const std::string& component, const idl::TaskState& task, JsonWriter& json);

/// Carries out tasks: shows the tasks of a running system, or gives one of them an order.
[[nodiscard]] ExitCode handle_tasks(const apps::Call& call);

}  // namespace orca::orcactl
