// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/batch/statistics/interval.hpp"

namespace orca::batch {

constexpr std::uint64_t kLeastRuns = 9;  ///< Runs of each algorithm that a claim needs.
constexpr double kLargestPValue = 0.05;  ///< Largest adjusted p-value that supports a claim.

/// The evidence about the difference of two algorithms in one metric.
struct Comparison {
  std::uint64_t first_runs = 0;
  std::uint64_t second_runs = 0;
  double adjusted_p = 1.0;  ///< From a paired test, after holm() over all tests of the report.
  Interval difference;      ///< The paired one, by bootstrap_difference().
};

/// A reason why a difference is not established.
enum class Doubt {
  too_few_runs,            ///< One of the algorithms has fewer than kLeastRuns runs.
  interval_includes_zero,  ///< An end of the interval that is exactly 0 counts.
  p_value_too_large,       ///< Above kLargestPValue.
};

/// The words of a report about a difference.
struct Verdict {
  std::vector<Doubt> doubts;  ///< All that apply, in the order of the enumeration.
  std::string text;  ///< "difference established", or "not established: " and the reasons with their numbers.

  [[nodiscard]] bool established() const { return doubts.empty(); }
};

/// Decides whether a difference is established: at least 9 runs of each algorithm, an adjusted p-value of at most 0.05 and an
/// interval that excludes 0. "Not established" does not say that the algorithms are equal.
///
/// @errors  invalid_argument if the p-value is not in [0, 1], or if the ends of the interval are not finite or not in order.
/// @thread  a pure function; any thread.
[[nodiscard]] Result<Verdict> judge(const Comparison& comparison);

}  // namespace orca::batch
