// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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

/// The origin of results, from which their runs can be made again. A plain value.
struct Origin {
  std::string file;                  ///< The experiment's path, absolute.
  std::vector<std::string> plugins;  ///< Folders of plugins besides Orca's own.
};

/// The files and programs that runs depend on: names and hashes of their content.
using Inputs = std::map<std::string, std::string>;

/// Something that an experiment declares before its results are looked at. A plain value.
struct Declaration {
  std::string what;  ///< "metrics", "contrasts", "seeds" or "worlds"; or kBuildDeclaration.
  std::string text;  ///< For people.
  std::string date;  ///< The first time that it was declared, "2026-11-28 21:40 UTC".
};

/// A run that was made twice, by the names of the experiment.
struct RepeatRow {
  std::string variant;
  std::string world;
  std::uint64_t seed = 0;
  Repeat repeat;
};

/// The results of an experiment in a file, an SQLite database: its tables are `runs`, `timing`, `repeats`, `declarations` and `experiment`. When add()
/// returns, the result is in the file, whatever becomes of this process.
///
/// Thread contract: not synchronised; one thread. One process at a time writes to a file.
class Store {
 public:
  /// Opens a file, or makes it.
  /// @param identity  of the experiment: results of another one are not mixed with these. Empty: whatever the file holds.
  /// @param origin    is kept in a file that holds no results yet.
  /// @errors  failed_precondition if the file holds results of another experiment, or was made by another version; unavailable
  ///          with the reason if it cannot be opened, or is no database.
  static Result<std::unique_ptr<Store>> open(const std::string& file, const std::string& identity,
                                             const Origin& origin = {});
  virtual ~Store() = default;

  /// Adds a run. Nothing if it is there already.
  /// @errors  unavailable, with the reason.
  virtual Status add(const Row& row) = 0;
  /// Returns whether the run is there.
  [[nodiscard]] virtual bool has(const std::string& variant, const std::string& world,
                                 std::uint64_t seed) const = 0;
  /// Returns a run without its sketch; nothing if it is not there.
  [[nodiscard]] virtual std::optional<Row> find(const std::string& variant, const std::string& world,
                                                std::uint64_t seed) const = 0;
  /// Returns Outcome::sketch of a run; empty if it is not there.
  [[nodiscard]] virtual Sketch sketch(const std::string& variant, const std::string& world,
                                      std::uint64_t seed) const = 0;
  /// Hands out all runs without their sketches, ordered by variant, world and seed.
  virtual Status for_each(const std::function<void(const Row&)>& take) const = 0;

  /// Adds what came of making a run twice. Nothing if it is there already.
  /// @errors  unavailable, with the reason.
  virtual Status add(const RepeatRow& row) = 0;
  /// Returns the runs that were made twice, ordered by variant, world and seed. There are a few of each variant.
  [[nodiscard]] virtual std::vector<RepeatRow> repeats() const = 0;

  /// Keeps what the runs depend on that are to be added.
  /// @errors  failed_precondition with the names of those that were others for runs that are there already; unavailable, with the
  ///          reason. Then nothing is kept.
  virtual Status keep(const Inputs& inputs) = 0;
  /// Returns all that the runs depend on.
  [[nodiscard]] virtual Inputs inputs() const = 0;

  /// Keeps what the experiment declares. A declaration that is there already keeps its date. The
  /// dates of the first ones say so if there are runs already. No run depends on it.
  /// @errors  unavailable, with the reason. Then nothing is kept.
  virtual Status declare(const std::vector<Declaration>& declarations) = 0;
  /// Returns everything that was ever declared, the earliest first.
  [[nodiscard]] virtual std::vector<Declaration> declarations() const = 0;

  /// Adds everything of another file of results. Runs that are in both must be the same.
  /// @errors  failed_precondition if it is of another experiment, or of other inputs, or another outcome of the same run is
  ///          there; those of open(). Then nothing is added.
  virtual Status take_over(const std::string& other) = 0;

  /// Returns the identity of the experiment; empty if the file holds no results yet.
  [[nodiscard]] virtual std::string identity() const = 0;
  /// Returns where the results come from; without a file if that is not known.
  [[nodiscard]] virtual Origin origin() const = 0;
};

}  // namespace orca::batch
