// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::batch {

/// Values of one metric by world: a list for each world, and in it a number for each run, ordered by seed. Worlds may have
/// different numbers of runs.
using ValuesByWorld = std::span<const std::vector<double>>;

/// Summaries of values. Each returns invalid_argument if there are no values or if one is not finite or beyond 1e300, and the
/// value itself if there is one. If all values are equal, the result is that value to the last bit.
///
/// @thread  pure functions; any thread.

/// Returns the mean.
[[nodiscard]] Result<double> mean(std::span<const double> values);

/// Returns the value below which the share `q` of the values lies: between the sorted values x_0 ... x_(n-1) it interpolates
/// linearly at the position q (n - 1).
/// @errors  also if `q` is not in [0, 1].
/// @source  definition 7 of Hyndman and Fan, "Sample quantiles in statistical packages", The American Statistician 50(4), 1996.
///          It equals NumPy's quantile(values, q, method="linear"), its default.
[[nodiscard]] Result<double> quantile(std::span<const double> values, double q);

/// Returns the quantile 0.5, the mean of the two middle values if their number is even.
[[nodiscard]] Result<double> median(std::span<const double> values);

/// Returns the mean of the middle half: of n sorted values floor(n / 4) are dropped at each end. It is the plain mean for n < 4.
/// @source  Agarwal, Schwarzer, Castro, Courville and Bellemare, "Deep reinforcement learning at the edge of the statistical
///          precipice", NeurIPS 2021. It equals SciPy's trim_mean(values, 0.25).
[[nodiscard]] Result<double> interquartile_mean(std::span<const double> values);

/// Returns the mean of each world, in their order. Runs of one world resemble each other; a test that takes its pairs as
/// independent, such as wilcoxon(), claims too much if it gets all runs of few worlds, and not if it gets these means. See the
/// last test of tests/unit/batch/statistics/two_algorithms_test.cpp.
/// @errors  invalid_argument if there is no world, a world without a run, or if a value is not finite or beyond 1e300.
[[nodiscard]] Result<std::vector<double>> world_means(ValuesByWorld worlds);

/// Returns first - second for each world and seed. The worlds, and the seeds in each of them, must be the same in both.
/// @errors  invalid_argument if there is no world, a world without a run, another number of worlds or of the runs of a world,
///          or if a value or a difference is not finite or beyond 1e300.
[[nodiscard]] Result<std::vector<std::vector<double>>> paired_differences(ValuesByWorld first,
                                                                          ValuesByWorld second);

/// Returns the probability that a run of the first algorithm has a larger value than a run of the second one in the same world,
/// P(X > Y) + P(X = Y) / 2, over all pairs of runs of a world and then as the mean over worlds, each with the same weight. The
/// numbers of runs may differ. It is 0.5 for equal algorithms, and 1 - p if they are swapped.
/// @errors  invalid_argument if there is no world, another number of worlds, a world without a run, or if a value is not
///          finite or beyond 1e300.
/// @source  Agarwal et al., as above.
[[nodiscard]] Result<double> probability_of_improvement(ValuesByWorld first, ValuesByWorld second);

}  // namespace orca::batch
