// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "document.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/store.hpp"

namespace orca::batch {

/// Adds where results come from: when and by which builds they were made, of what, in which respects the variants differ, and the
/// experiment's own text. Paths start at the experiment's folder.
void add_provenance(const Experiment& experiment, const Store& store, Document& document);

/// Returns a value that may be a path as it is written from the experiment's folder on; the value itself if it is no absolute path.
[[nodiscard]] std::string from_folder_of(const Experiment& experiment, const std::string& value);

}  // namespace orca::batch
