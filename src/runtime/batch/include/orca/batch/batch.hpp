// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/one_run.hpp"
#include "orca/batch/record.hpp"

namespace orca::batch {

/// The application's observer of a batch.
///
/// Thread contract: called by the thread of run_batch().
class BatchListener {
 public:
  virtual ~BatchListener() = default;
  /// Takes the outcome of a run. A batch that is stopped has done what is stored here.
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

/// The runs of a batch, by their numbers.
struct BatchPlan {
  /// These are made first, and once more in other circumstances: another memory layout, process, environment and folder. One of
  /// each variant shows whether it depends on these.
  std::vector<std::size_t> twice{};
  /// Hands out the other runs one after the other, then nothing. A batch of any size needs no list of them.
  std::function<std::optional<std::size_t>()> next{};
};

/// The end of a batch.
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

}  // namespace orca::batch
