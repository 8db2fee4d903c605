// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "document.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/store.hpp"

namespace orca::batch {

/// Adds a section with the processor time per lap of each component, if the runs have any.
void add_processor_time(const Experiment& experiment, const std::vector<Row>& rows, Document& document);

}  // namespace orca::batch
