// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>

#include "orca/base/result.hpp"
#include "orca/batch/statistics/estimate.hpp"
#include "orca/batch/statistics/paired_tests.hpp"
#include "orca/batch/statistics/sample.hpp"

namespace orca::batch {

/// The kind of a metric.
enum class Quantity {
  success,  ///< 1 or 0 for each run.
  number    ///< Any number, such as a time.
};

/// The test that gives a p-value.
enum class Test {
  sign_flips,  ///< sign_flips().
  student      ///< student_p().
};

constexpr std::size_t kLeastRuns = 9;  ///< Runs of each algorithm that a claim needs.

/// The most values that Finding::values_needed() says; it may be more.
constexpr std::size_t kMostNeeded = 100'000;

/// A claim about two algorithms.
enum class Claim {
  difference,  ///< Whether their means differ.
  not_worse,   ///< Whether the first is worse than the second by less than a margin.
  equal        ///< Whether they differ by less than a margin, either way.
};

/// A question about two algorithms in one metric. A plain value.
struct Asked {
  Claim claim = Claim::difference;
  double margin = 0.0;          ///< In the metric's unit, above 0 where the claim has one.
  bool more_is_better = false;  ///< Whether a larger value is better.
};

/// The evidence about the difference of two algorithms in one metric. A plain value.
struct Finding {
  std::size_t runs = 0;  ///< Pairs of runs.
  Scope scope{};         ///< The worlds of these.
  Asked asked{};
  Test test = Test::sign_flips;
  double p =
      1.0;  ///< Before any correction for other tests. Small if the data contradict that the claim is false.
  Estimate difference{};  ///< first - second.
  double spread = 0.0;    ///< Standard deviation of the values of the Sample.

  /// Returns whether the test cannot give a p-value of 0.05, whatever the values are.
  [[nodiscard]] bool has_too_few_worlds() const {
    return test == Test::sign_flips && scope.over_worlds() && scope.worlds < kFewestFlipped;
  }
  /// Returns whether the interval lies where the claim says that the difference does.
  [[nodiscard]] bool interval_supports_claim() const;
  /// Returns whether all of the interval lies beyond the margin, where the claim says that the difference does not lie.
  [[nodiscard]] bool interval_contradicts_claim() const;
  /// Returns how many worlds (runs where the worlds are fixed) show the claim with a probability of 80 %, if values spread as those here. The true
  /// difference is the observed one if that is asked for; with a margin it is 0. Nothing if there is no spread, no difference, or
  /// if interval_contradicts_claim(): no number of values is likely to show it.
  /// @source  Julious, "Sample sizes for clinical trials with normal data", Statistics in Medicine 23, 2004, for paired values:
  ///          (t1 + t2)^2 spread^2 / distance^2, with Student's t1 for 0.975 and t2 for 0.8, or 0.9 for Claim::equal.
  [[nodiscard]] std::optional<std::size_t> values_needed() const;
};

/// The options of find_difference(); others than these are for tests that make many findings.
struct FindingOptions {
  BootstrapOptions bootstrap{};
  SignFlipOptions flips{};
};

/// Compares two algorithms that met the same worlds and seeds, by the sample_of() their paired_differences(): what makes a world hard
/// for both cancels out. Test and interval are about the same mean of the same values. The test is sign_flips(), and Student's for
/// numbers of fewer than 6 values.
///
/// With a margin the test is one-sided: the values are moved by the margin, p is the two-sided one if the mean lies on the claim's side, so that
/// p <= 0.05 is a level of 2.5 %, and otherwise 1. Claim::equal needs both sides, and p is the larger of the two.
/// @errors  those of paired_differences().
/// @thread  a pure function; any thread.
/// @source  Schuirmann, "A comparison of the two one-sided tests procedure and the power approach", Journal of Pharmacokinetics and
///          Biopharmaceutics 15(6), 1987.
[[nodiscard]] Result<Finding> find_difference(ValuesByWorld first, ValuesByWorld second, Quantity quantity,
                                              const Asked& asked = {}, const FindingOptions& options = {});

}  // namespace orca::batch
