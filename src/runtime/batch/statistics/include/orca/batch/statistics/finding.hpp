// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>

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

/// The evidence about the difference of two algorithms in one metric. A plain value.
struct Finding {
  std::size_t runs = 0;  ///< Pairs of runs.
  Scope scope;           ///< The worlds of these.
  Test test = Test::sign_flips;
  double p = 1.0;       ///< Before any correction for other tests.
  Estimate difference;  ///< first - second.

  /// Returns whether the test cannot give a p-value of 0.05, whatever the values are.
  [[nodiscard]] bool has_too_few_worlds() const {
    return test == Test::sign_flips && scope.over_worlds() && scope.worlds < kFewestFlipped;
  }
};

/// The options of find_difference(); others than these are for tests that make many findings.
struct FindingOptions {
  BootstrapOptions bootstrap{};
  SignFlipOptions flips{};
};

/// Compares two algorithms that met the same worlds and seeds, by the sample_of() their paired_differences(): what makes a world hard
/// for both cancels out. Test and interval are about the same mean of the same values. The test is sign_flips(), and Student's for
/// numbers of fewer than 6 values.
/// @errors  those of paired_differences().
/// @thread  a pure function; any thread.
[[nodiscard]] Result<Finding> find_difference(ValuesByWorld first, ValuesByWorld second, Quantity quantity,
                                              const FindingOptions& options = {});

}  // namespace orca::batch
