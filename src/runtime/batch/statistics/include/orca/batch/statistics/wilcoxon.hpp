// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "orca/base/result.hpp"

namespace orca::batch {

/// The result of Wilcoxon's signed-rank test.
struct Wilcoxon {
  std::size_t used = 0;         ///< Pairs whose values differ; the others were dropped.
  double positive_ranks = 0.0;  ///< Sum of the ranks of positive differences.
  double negative_ranks = 0.0;  ///< Sum of the ranks of negative differences.
  bool exact = true;  ///< Whether p is of the exact distribution, and not of the normal approximation.
  double p = 1.0;     ///< Two-sided, in [0, 1].
};

/// Tests whether the differences of pairs are distributed symmetrically about 0, by the ranks of their sizes. Zeros are
/// dropped; sizes that are equal to the last bit share the mean of their ranks. The p-value is 1 if all differences are 0. It
/// depends neither on the order of the pairs nor on which algorithm is the first.
///
/// The distribution is exact for up to 25 pairs without zeros and without equal sizes, and otherwise the normal approximation
/// with correction for equal sizes and without continuity correction. The approximation rejects too often
/// if few differences are left: 5 or 6 of different sizes, beside a zero, have p <= 0.05 in 6.25 % of the cases where the
/// algorithms are equal.
///
/// The pairs are taken as independent of each other; see world_means() about several seeds of one world.
/// @param first, second  values of two algorithms, paired by position, in one unit.
/// @param differences    first - second, pair by pair.
/// @errors  invalid_argument if there are no pairs, if the lists have different lengths, or if a difference is not finite or
///          beyond 1e300.
/// @thread  pure functions; any thread.
/// @source  Wilcoxon, "Individual comparisons by ranking methods", Biometrics Bulletin 1(6), 1945; tie correction as in
///          Hollander, Wolfe and Chicken, "Nonparametric statistical methods", 3rd ed., 2014, section 3.1. It equals SciPy's
///          wilcoxon(first, second, zero_method="wilcox", correction=False, alternative="two-sided", method=M) with M "exact"
///          or "approx" as above ("mode" before SciPy 1.9); its statistic is the smaller of the two sums.
[[nodiscard]] Result<Wilcoxon> wilcoxon(std::span<const double> differences);
[[nodiscard]] Result<Wilcoxon> wilcoxon(std::span<const double> first, std::span<const double> second);

}  // namespace orca::batch
