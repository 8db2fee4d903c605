// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/base/result.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/record.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::batch {

struct BatchOptions {
  std::vector<std::string> plugin_folders;  ///< Where plugins are looked for.
  Backend backend = Backend::fiber;         ///< fiber or baton.
  std::size_t jobs = 1;                     ///< Runs at a time, each in a process of its own.
};

/// The application's observer of a batch.
///
/// Thread contract: called by the thread of run_batch().
class BatchListener {
 public:
  virtual ~BatchListener() = default;
  /// Takes the outcome of a run. What it stores is what a batch that is stopped has done.
  /// @errors  end the batch.
  virtual Status finished(std::size_t number, const Outcome& outcome, const Cost& cost) = 0;
  /// Called a few times a second.
  virtual void tick(std::size_t running) = 0;
};

/// Checks the graphs of all variants in all worlds against their plugins, as deployer --check does. It runs nothing.
/// @param diagnostics  receives everything that is wrong, each once.
/// @thread  the main thread, while there is no other.
void check_graphs(const Experiment& experiment, const BatchOptions& options, xml::Diagnostics& diagnostics);

/// Makes runs of an experiment, each in virtual time in a fresh process, so that whatever happens to one costs no other. A
/// run that crashes or hangs has an outcome, too.
/// @param wanted  numbers of the runs, begun in this order.
/// @return whether all were made: SIGINT and SIGTERM end the batch, and the runs that are under way are given up.
/// @errors  those of the listener; unavailable if no process can be started.
/// @thread  the main thread, while there is no other.
[[nodiscard]] Result<bool> run_batch(const Experiment& experiment, const std::vector<std::size_t>& wanted,
                                     const BatchOptions& options, BatchListener& listener);

}  // namespace orca::batch
