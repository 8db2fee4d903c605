// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "orca/batch/experiment.hpp"
#include "orca/batch/one_run.hpp"
#include "orca/batch/store.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::batch {

/// Checks the graphs of all variants in all worlds against their plugins, as deployer --check does. It runs nothing.
/// @param experiment   may be one of which errors are in `diagnostics` already, see read_parts(). Then those of its tuner's worlds are
///                     looked for, too.
/// @param diagnostics  receives everything that is wrong, each once.
/// @param watch        is called before each graph; empty: nobody watches.
/// @thread  the main thread, while there is no other.
void check_graphs(const Experiment& experiment, const BatchOptions& options, xml::Diagnostics& diagnostics,
                  const std::function<void(std::size_t done, std::size_t all)>& watch = {});

/// Returns what the runs of an experiment depend on besides its own file: this program and Orca's libraries, the plugins, the
/// files that this process has read for the graphs or that the graphs name, and what the experiment says of each world. Names of
/// files start at the experiment's folder, so that they are the same on all machines.
/// @pre  check_graphs() was called, and found no errors.
/// @thread  any.
[[nodiscard]] Inputs inputs_of(const Experiment& experiment);

/// Returns the files that an experiment's runs read: its own, its tables of references, and all that its graphs include, name or
/// that their worlds lead to. Plugins are not among them. Absolute paths, without links, each once, sorted.
/// @pre  check_graphs() was called, and found no errors.
/// @thread  any.
[[nodiscard]] std::vector<std::string> files_of(const Experiment& experiment);

/// Returns a hash of a file's content, which shows a change that nobody wanted to hide; nothing if it is no file, or cannot be read.
/// @thread  any.
[[nodiscard]] std::optional<std::string> content_hash(const std::string& file);

}  // namespace orca::batch
