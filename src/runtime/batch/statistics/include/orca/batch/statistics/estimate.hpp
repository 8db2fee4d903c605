// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "orca/base/result.hpp"
#include "orca/batch/statistics/interval.hpp"

namespace orca::batch {

/// The options of a bootstrap.
struct BootstrapOptions {
  std::uint64_t seed =
      1;  ///< For a random stream of its own: the same seed gives the same bits on every machine.
  std::size_t draws = 10'000;  ///< Resamples, at least 1. Each takes 8 bytes and a step for each value.
};

/// A mean of values and how well it is known.
struct Estimate {
  double value = 0.0;  ///< From the values as they are.
  Interval interval;   ///< 95 %.
};

/// From so many values on an interval is one by a bootstrap.
constexpr std::size_t kFewestBootstrapped = 10;

/// Estimates the mean of the distribution from which independent values were drawn: those of a Sample.
///
/// Below 10 values the interval is Student's. From 10 on it is a bootstrap's: a draw takes as many values as there are, with
/// replacement, and the interval reaches between two quantiles of the means of the draws. These are not 0.025 and
/// 0.975, with which an interval of 10 values would be as narrow as one of 90 %, but the expanded ones of Hesterberg: q and 1 - q,
/// q = Phi(-t sqrt(n / (n - 1))), with Student's t of n - 1 degrees of freedom.
///
/// One value has an interval without ends. Equal values give themselves, to the last bit, and an interval of zero width.
/// @pre     fewer than 2^32 values
/// @errors  invalid_argument if there are no draws, no values, or if a value is not finite or beyond 1e300.
/// @thread  pure functions that start no threads; any thread.
/// @source  Hesterberg, "What teachers should know about the bootstrap", The American Statistician 69(4), 2015, section 5.3;
///          Davison and Hinkley, "Bootstrap methods and their application", 1997, section 3.8 (worlds are drawn whole).
[[nodiscard]] Result<Estimate> estimate_mean(std::span<const double> values,
                                             const BootstrapOptions& options = {});

/// Does the same for shares of successes, or for differences of shares. No interval leaves `limits`. Equal shares, such as 20
/// times 100 %, do not show that another can never differ: their interval is wider by Wilson's for 0 of as many as there are values.
/// @param limits  0 and 1 for shares, -1 and 1 for differences.
[[nodiscard]] Result<Estimate> estimate_share(std::span<const double> values, const Interval& limits,
                                              const BootstrapOptions& options = {});

}  // namespace orca::batch
