// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/batch/experiment.hpp"

namespace orca::batch {

/// The options of a batch's runs. A plain value.
struct BatchOptions {
  std::vector<std::string> plugin_folders;  ///< Where plugins are looked for.
  Backend backend = Backend::fiber;         ///< fiber or baton.
  std::size_t jobs = 1;                     ///< Runs at a time, each in a process of its own.
  /// The words that start a program which calls make_alone() with what follows them: the experiment's file, the run's number, the
  /// descriptors for outcome and trace, the executor and the plugin folders. Empty: runs in other circumstances are made by
  /// copies of this process, too, and then have its addresses of code.
  std::vector<std::string> alone{};
};

/// Makes one run in this process, with another memory layout and in another folder, and ends the process.
/// @param to     descriptor for the outcome.
/// @param trace  descriptor for all deliveries; -1: none.
/// @thread  the main thread, while there is no other.
[[noreturn]] void make_alone(const Experiment& experiment, std::size_t number, const BatchOptions& options,
                             int to, int trace);

}  // namespace orca::batch
