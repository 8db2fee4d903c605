// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
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
  /// The words that start a program which calls make_alone() with what follows them: the experiment's file, the run's number, the
  /// descriptors for outcome and trace, the executor and the plugin folders. Empty: runs in other circumstances are made by
  /// copies of this process, too, and then have its addresses of code.
  std::vector<std::string> alone{};
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
  /// Takes what came of making a run twice.
  /// @errors  end the batch.
  virtual Status repeated(std::size_t /*number*/, const Repeat& /*repeat*/) { return ok(); }
  /// Reports that the machine did not let a run come to its end, which is no result.
  /// @param again  it is made once more later; false: it was tried often enough, and is left out.
  virtual void overloaded(std::size_t /*number*/, const std::string& /*why*/, bool /*again*/) {}
  /// Called a few times a second.
  virtual void tick(std::size_t running) = 0;
};

/// Checks the graphs of all variants in all worlds against their plugins, as deployer --check does. It runs nothing.
/// @param experiment   may be one of which errors are in `diagnostics` already, see read_parts().
/// @param diagnostics  receives everything that is wrong, each once.
/// @param watch        is called before each graph; empty: nobody watches.
/// @thread  the main thread, while there is no other.
void check_graphs(const Experiment& experiment, const BatchOptions& options, xml::Diagnostics& diagnostics,
                  const std::function<void(std::size_t done, std::size_t all)>& watch = {});

/// The runs of a batch, by their numbers.
struct BatchPlan {
  /// These are made first, and once more in other circumstances: another memory layout, process, environment and folder. One of
  /// each variant shows whether it depends on these.
  std::vector<std::size_t> twice{};
  /// Hands out the other runs one after the other, then nothing. A batch of any size needs no list of them.
  std::function<std::optional<std::size_t>()> next{};
};

/// How a batch ended.
enum class BatchEnd {
  complete,   ///< All runs were made.
  stopped,    ///< By SIGINT or SIGTERM. The runs that were under way are given up.
  overloaded  ///< Some runs were left out, because the machine did not let them come to their end.
};

/// Makes runs of an experiment, each in virtual time in a fresh process, so that whatever happens to one costs no other. A
/// run that crashes or hangs has an outcome, too.
/// @errors  those of the listener; unavailable if no process can be started.
/// @thread  the main thread, while there is no other.
[[nodiscard]] Result<BatchEnd> run_batch(const Experiment& experiment, const BatchPlan& plan,
                                         const BatchOptions& options, BatchListener& listener);

/// Makes one run in this process, with another memory layout and in another folder, and ends the process.
/// @param to     descriptor for the outcome.
/// @param trace  descriptor for all deliveries; -1: none.
/// @thread  the main thread, while there is no other.
[[noreturn]] void make_alone(const Experiment& experiment, std::size_t number, const BatchOptions& options,
                             int to, int trace);

}  // namespace orca::batch
