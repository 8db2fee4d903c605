// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/batch/experiment.hpp"
#include "orca/batch/store.hpp"

namespace orca::batch {

/// Returns what the runs of an experiment depend on besides its own file: this program and Orca's libraries, the plugins, the
/// files that this process has read for the graphs or that the graphs name, and what the experiment says of each world. Names of
/// files start at the experiment's folder, so that they are the same on all machines.
/// @pre  check_graphs() was called, and found no errors.
/// @thread  any.
[[nodiscard]] Inputs inputs_of(const Experiment& experiment);

}  // namespace orca::batch
