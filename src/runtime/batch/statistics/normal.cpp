// SPDX-License-Identifier: LGPL-3.0-or-later
#include "normal.hpp"

#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"

namespace orca::batch {
namespace {

constexpr double kSeriesEnd = 1.5;
// The fraction converges slowest where it begins, at kSeriesEnd, where 100 terms leave no error that a double shows.
constexpr int kFractionTerms = 100;

// erf(x) = 2 / sqrt(pi) exp(-x^2) sum of 2^n x^(2n+1) / (1 3 ... (2n+1)); all terms are positive.
double erf_by_series(double x) {
  double term = x;
  double sum = x;
  for (int odd = 3; term > sum * 0x1p-60; odd += 2) {
    term *= 2.0 * x * x / odd;
    sum += term;
  }
  return 2.0 * std::numbers::inv_sqrtpi * portable::exp(-x * x) * sum;
}

// erfc(x) = exp(-x^2) / sqrt(pi) / (x + (1/2) / (x + (2/2) / (x + (3/2) / (x + ...)))).
double erfc_by_fraction(double x) {
  double fraction = x;
  for (int k = kFractionTerms; k > 0; --k) fraction = x + 0.5 * k / fraction;
  return std::numbers::inv_sqrtpi * portable::exp(-x * x) / fraction;
}

}  // namespace

double erfc_of_positive(double x) { return x < kSeriesEnd ? 1.0 - erf_by_series(x) : erfc_by_fraction(x); }

double two_sided_normal_tail(double z) { return erfc_of_positive(std::fabs(z) / std::numbers::sqrt2); }

}  // namespace orca::batch
