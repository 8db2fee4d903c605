// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/batch/statistics/summary.hpp"

namespace orca::batch {

/// From so many worlds on a claim is about their kind, and worlds are what is drawn. One or two say nothing about others.
constexpr std::size_t kFewestDrawnWorlds = 3;
/// From so many worlds on a claim does not have to name them.
constexpr std::size_t kManyWorlds = 10;

/// The places that a claim is about. A plain value.
struct Scope {
  std::size_t worlds = 0;

  /// Returns whether the worlds count as drawn from their kind. Otherwise they are fixed, and the seeds in them are drawn.
  [[nodiscard]] bool over_worlds() const { return worlds >= kFewestDrawnWorlds; }
  /// Returns " in this world", " in these 4 worlds", or nothing where there are many.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const Scope&, const Scope&) = default;
};

/// The values from which a mean is estimated, independent of each other: a mean for each world, or a value for each run where
/// there are too few worlds. Each world counts the same, however many runs it has. A plain value.
struct Sample {
  std::vector<double> values;
  Scope scope;
};

/// Returns the sample of values by world. Runs of one world resemble each other, so from three worlds on each world is one value.
/// @errors  those of world_means().
/// @thread  a pure function; any thread.
[[nodiscard]] Result<Sample> sample_of(ValuesByWorld worlds);

}  // namespace orca::batch
