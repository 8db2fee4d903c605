// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/batch/statistics/finding.hpp"

namespace orca::batch {

constexpr double kLargestPValue = 0.05;  ///< Largest adjusted p-value that supports a claim.

/// A reason why a claim is not established.
enum class Doubt {
  too_few_runs,    ///< One of the algorithms has fewer than kLeastRuns runs.
  too_few_worlds,  ///< Finding::has_too_few_worlds().
  interval_too_wide,  ///< It includes 0, or reaches the margin or lies beyond it. An end that is exactly there counts.
  p_value_too_large,  ///< Above kLargestPValue.
  reversed,           ///< Families of worlds contradict each other; a report says so, not judge().
};

/// The words of a report about a claim.
struct Verdict {
  std::vector<Doubt>
      doubts;  ///< All that apply, in the order of the enumeration; the last two only where there is enough to judge by.
  /// "difference established", or "established" of a claim with a margin, with Scope::text(); or "not established: " and the
  /// reasons with their numbers.
  std::string text;

  [[nodiscard]] bool established() const { return doubts.empty(); }
};

/// Returns whether there are runs and worlds enough for a claim, whatever they are like. A test without this can find nothing, so holm()
/// need not count it.
/// @source  Tarone, "A modified Bonferroni method for discrete data", Biometrics 46(2), 1990.
[[nodiscard]] bool is_enough(const Finding& finding);

/// Decides whether a claim is established: at least 9 runs of each algorithm, an adjusted p-value of at most 0.05 and an
/// interval that supports the claim: one that excludes 0, or one within the margin. A difference that is not established does not say that the
/// algorithms are equal.
///
/// @param adjusted_p  Finding::p after holm() over all tests of the report.
/// @errors  invalid_argument if the p-value is not in [0, 1], or if the ends of the interval are not in order.
/// @thread  a pure function; any thread.
[[nodiscard]] Result<Verdict> judge(const Finding& finding, double adjusted_p);

}  // namespace orca::batch
