// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "orca/batch/experiment.hpp"
#include "orca/batch/store.hpp"

namespace orca::batch {

/// One of several parts of an experiment, which different machines run. All variants of a world and seed are in the same part,
/// so that they can be compared in pairs. A plain value.
struct Shard {
  std::size_t number = 1;  ///< From 1.
  std::size_t count = 1;

  /// Returns whether it holds a run of the experiment.
  [[nodiscard]] bool holds(const Experiment& experiment, std::size_t run) const {
    return run / experiment.variants.size() % count == number - 1;
  }
};

/// The runs of a shard that a store does not hold yet, one after the other. They take no memory, however many they are.
///
/// Thread contract: one thread, which may use the store.
class MissingRuns {
 public:
  MissingRuns(const Experiment& experiment, const Store& store, const Shard& shard)
      : experiment_(experiment), store_(store), shard_(shard) {}

  /// Returns the number of the next run that the store does not hold at this moment; nothing if there is none.
  [[nodiscard]] std::optional<std::size_t> next();

  /// Returns how many the store does not hold now, from the first run of the shard on.
  [[nodiscard]] std::size_t count() const;

  /// Returns how many runs are to be made: those that are missing, and of those to be made twice the ones that are there already.
  [[nodiscard]] std::size_t count_with(const std::vector<std::size_t>& twice) const;

  /// Returns the runs of the shard that are to be made twice, evenly spread over its worlds and seeds: one in seven of each
  /// variant up to seven, and one in a hundred beyond. Those of which the store has as many are left out.
  [[nodiscard]] std::vector<std::size_t> not_repeated() const;

 private:
  [[nodiscard]] bool is_missing(std::size_t run) const;

  const Experiment& experiment_;
  const Store& store_;
  const Shard shard_;
  std::size_t next_ = 0;
};

}  // namespace orca::batch
