// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>

#include "orca/batch/one_run.hpp"

namespace orca::batch {

/// The character between the outcome and the line of what its laps cost.
inline constexpr char kLapsFollow = '\f';

/// The plan of a worker: how a run is made.
struct WorkPlan {
  int to = -1;             ///< Descriptor of the pipe for the outcome.
  int trace = -1;          ///< Descriptor of a pipe for all deliveries with their values; -1: none.
  bool elsewhere = false;  ///< With another memory layout and in another folder than the process has.
};

/// Makes a run in this process, writes its outcome to a pipe, and ends the process.
/// @thread  the only thread of a process that was made for it.
[[noreturn]] void work(const Experiment& experiment, const Run& run, const BatchOptions& options,
                       const WorkPlan& plan);

/// Starts the program of BatchOptions::alone in this process, which makes the run in other circumstances.
/// @param plan  the descriptors that it names are inherited.
/// @pre  this process is a copy that was made for it.
[[noreturn]] void work_elsewhere(const Experiment& experiment, std::size_t number,
                                 const BatchOptions& options, const WorkPlan& plan);

}  // namespace orca::batch
