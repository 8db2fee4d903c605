// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "orca/base/result.hpp"
#include "orca/batch/record.hpp"

namespace orca::batch {

/// A run that was made, by the names of the experiment.
struct Row {
  std::string variant;
  std::string world;
  std::uint64_t seed = 0;
  Outcome outcome;
  Cost cost;
};

/// The results of an experiment in a file, an SQLite database: its tables are `runs`, `timing` and `experiment`. What add() has
/// returned is in the file, whatever becomes of this process.
///
/// Thread contract: not synchronised; one thread. One process at a time writes to a file.
class Store {
 public:
  /// Opens a file, or makes it.
  /// @param identity  of the experiment: results of another one are not mixed with these. Empty: whatever the file holds.
  /// @errors  failed_precondition if the file holds results of another experiment, or was made by another version; unavailable with the reason if it cannot be
  ///          opened, or is no database.
  static Result<std::unique_ptr<Store>> open(const std::string& file, const std::string& identity);
  virtual ~Store() = default;

  /// Adds a run. Nothing if it is there already.
  /// @errors  unavailable, with the reason.
  virtual Status add(const Row& row) = 0;
  /// Returns whether the run is there.
  [[nodiscard]] virtual bool has(const std::string& variant, const std::string& world,
                                 std::uint64_t seed) const = 0;
  /// Returns Outcome::sketch of a run; empty if it is not there.
  [[nodiscard]] virtual Sketch sketch(const std::string& variant, const std::string& world,
                                      std::uint64_t seed) const = 0;
  /// Hands out all runs without their sketches, ordered by variant, world and seed.
  virtual Status for_each(const std::function<void(const Row&)>& take) const = 0;
};

}  // namespace orca::batch
