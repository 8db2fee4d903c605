// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "options.hpp"
#include "orca/batch/experiment.hpp"

namespace orca::simbatch {

/// Hands an experiment to a Slurm cluster as an array of parts and a job that joins them, and shows on stderr how far they are until
/// all have ended. Whoever stops it stops the looking on only.
/// @pre  the experiment has no fault.
ExitCode submit(const Options& options, const batch::Experiment& experiment);

}  // namespace orca::simbatch
