// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/batch/batch.hpp"

namespace orca::batch {

/// Makes a run in this process, writes its outcome to a pipe, and ends the process.
/// @param to  descriptor of the pipe.
/// @thread  the only thread of a process that was forked for it.
[[noreturn]] void work(const Experiment& experiment, const Run& run, const BatchOptions& options, int to);

}  // namespace orca::batch
