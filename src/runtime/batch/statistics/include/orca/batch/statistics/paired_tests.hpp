// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "orca/base/result.hpp"

namespace orca::batch {

/// The options of sign_flips().
struct SignFlipOptions {
  std::uint64_t seed =
      1;  ///< For a random stream of its own: the same seed gives the same bits on every machine.
  std::size_t draws = 100'000;  ///< Drawn choices of signs where there are too many to try all, at least 1.
};

/// The result of a permutation test.
struct SignFlips {
  std::size_t used = 0;  ///< Differences that are not 0; the others have no sign.
  bool exact = true;     ///< Whether all choices of signs were tried, and not some drawn ones.
  double p = 1.0;        ///< Two-sided, in (0, 1].
};

/// The fewest values of which sign_flips() can give a p-value of 0.05 or less: 2 / 2^6 = 0.03.
constexpr std::size_t kFewestFlipped = 6;

/// Tests whether paired differences have the mean 0, by a permutation test: if the two algorithms are equal, each difference could as
/// well have the other sign. The p-value is the share of the choices of signs whose mean is at least as far from 0 as
/// that of the differences. It depends neither on their order, where it is exact, nor on which algorithm is the first.
///
/// All choices are tried of up to 20 differences that are not 0. Otherwise `draws` of them are drawn, and p is
/// (1 + those as far) / (1 + draws), which keeps the level. Means that are equal up to rounding count as equal.
/// With differences of -1, 0 and 1 it is McNemar's exact test.
///
/// @param differences  independent of each other, as those of a Sample.
/// @errors  invalid_argument if there are no differences or no draws, or if one is not finite or beyond 1e300.
/// @thread  a pure function; any thread.
/// @source  Fisher, "The design of experiments", 1935, section 21; Phipson and Smyth, "Permutation p-values should never be zero",
///          Statistical Applications in Genetics and Molecular Biology 9(1), 2010. It equals SciPy's
///          permutation_test((d,), numpy.mean, permutation_type="samples", n_resamples=numpy.inf) where it is exact.
[[nodiscard]] Result<SignFlips> sign_flips(std::span<const double> differences,
                                           const SignFlipOptions& options = {});

/// Returns the two-sided p-value of Student's t test that the mean is 0. It takes the differences as normal, and is for so few
/// of them that sign_flips() cannot speak. Equal differences have no spread to compare with: then p is that of sign_flips().
/// It is 1 of one difference.
/// @errors  invalid_argument if there are no differences, or if one is not finite or beyond 1e300.
/// @thread  a pure function; any thread.
/// @source  Student, "The probable error of a mean", Biometrika 6(1), 1908. It equals SciPy's ttest_1samp(differences, 0).pvalue.
[[nodiscard]] Result<double> student_p(std::span<const double> differences);

}  // namespace orca::batch
