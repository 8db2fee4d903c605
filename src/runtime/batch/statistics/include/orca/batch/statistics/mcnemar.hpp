// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "orca/base/result.hpp"

namespace orca::batch {

/// The outcome of two algorithms in the same world with the same seed.
struct SuccessPair {
  bool first = false;
  bool second = false;
};

/// The result of McNemar's test.
struct McNemar {
  std::uint64_t only_first = 0;   ///< Pairs in which only the first algorithm succeeded.
  std::uint64_t only_second = 0;  ///< Pairs in which only the second algorithm succeeded.
  double p = 1.0;                 ///< Two-sided, in [0, 1].
};

/// Tests whether two algorithms succeed equally often, by the exact binomial distribution of the discordant pairs. Pairs with
/// equal outcomes are dropped. The p-value is 1 if no discordant pair is left, and does not change if the algorithms are
/// swapped.
///
/// The pairs are taken as independent of each other; see world_means() about several seeds of one world.
/// @pre     counts: both below 2^52
/// @errors  invalid_argument if there are no pairs.
/// @thread  pure functions; any thread. The time grows as the square root of the number of discordant pairs.
/// @source  McNemar, "Note on the sampling error of the difference between correlated proportions or percentages",
///          Psychometrika 12, 1947, in its exact form. It equals SciPy's binomtest(only_first, only_first + only_second).pvalue;
///          the relative error is below 1e-13 for p-values from 1e-270 on and up to a million discordant pairs.
[[nodiscard]] McNemar mcnemar(std::uint64_t only_first, std::uint64_t only_second);
[[nodiscard]] Result<McNemar> mcnemar(std::span<const SuccessPair> pairs);

}  // namespace orca::batch
