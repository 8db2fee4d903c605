// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// Random search over the ranges that an experiment declares.
/// @source  J. Bergstra and Y. Bengio, "Random Search for Hyper-Parameter Optimization", JMLR 13, 2012, for the search; F. Hutter, H. Hoos,
///          K. Leyton-Brown and T. Stuetzle, "ParamILS", JAIR 36, 2009, for a failure that counts as ten times the limit of time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/store.hpp"

namespace orca::batch {

/// Returns the experiment that a tuner runs: each variant with ranges is there as often as there are draws, in the worlds of the tuner. NAME_0
/// has the declared values; in NAME_1, NAME_2, ... each range has a drawn one. A draw depends on the seed, the variant's name, its number
/// and the range's name alone.
/// @errors  failed_precondition if the experiment declares no tuning, or no variant has a range.
/// @thread  pure function; any thread.
[[nodiscard]] Result<Experiment> draws_of(const Experiment& experiment);

/// The result of one draw. A plain value.
struct Draw {
  std::size_t number = 0;
  std::vector<Setting> settings{};  ///< The drawn ones; the first draw has none.
  std::size_t runs = 0;
  std::size_t successes = 0;
  double penalised_time =
      0.0;  ///< [s] mean over its runs; one without success counts as ten times the experiment's limit.
  double robot_time = 0.0;  ///< [s] simulated in all its runs together.
};

/// The draws of one variant. A plain value.
struct Tuned {
  std::string variant;
  std::vector<Draw> draws;

  /// Returns the draw with the smallest penalised time; of several the first.
  [[nodiscard]] const Draw& best() const;
  /// Returns the budget and what came of it: "draw 7 of 16 (seed 1), ...".
  [[nodiscard]] std::string text(const Tuning& tuning) const;
};

/// Returns what came of all draws, in the order of the variants.
/// @param drawn  what draws_of() returned for it, of which the store holds all runs.
[[nodiscard]] std::vector<Tuned> judged(const Experiment& experiment, const Experiment& drawn,
                                        const Store& store);

/// Returns the best settings of a variant as a file that its attribute `settings` can name. A comment holds the budget.
[[nodiscard]] std::string settings_file(const Tuned& tuned, const Experiment& experiment);

/// Returns all draws as CSV.
[[nodiscard]] std::string draws_table(const std::vector<Tuned>& all);

}  // namespace orca::batch
