// SPDX-License-Identifier: LGPL-3.0-or-later
// Exponential, logarithm and lengths.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "error_free.hpp"
#include "orca/base/portable_math.hpp"

namespace orca::portable {
namespace {

// The natural logarithm of 2: 42 bits, whose products with exponents are exact, and the rest.
constexpr Pair kLog2{0x1.62e42fefa3800p-1, 0x1.ef35793c76730p-45};
constexpr double kMostExponent = 709.79;    // beyond, the result is infinite
constexpr double kLeastExponent = -745.14;  // below, it is 0

// Returns log((1 + s) / (1 - s)) - 2 s, by its series, for |s| <= 0.172.
double rest_of_log(double s) {
  const double square = s * s;
  const double series = polynomial(square, 2.0 / 23.0, 2.0 / 21.0, 2.0 / 19.0, 2.0 / 17.0, 2.0 / 15.0,
                                   2.0 / 13.0, 2.0 / 11.0, 2.0 / 9.0, 2.0 / 7.0, 2.0 / 5.0, 2.0 / 3.0);
  return s * square * series;
}

constexpr int kBias = 1023;    // of a double's exponent
constexpr int kFraction = 52;  // bits of its fraction
constexpr std::uint64_t kFractionMask = (std::uint64_t{1} << kFraction) - 1;

// For exponents of normal numbers.
double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + kBias) << kFraction);
}

struct Parts {
  double fraction;  // in [1, 2)
  double exponent;
};

// Returns a positive number as fraction * 2^exponent.
Parts parts_of(double x) {
  if (x < std::numeric_limits<double>::min()) {
    const Parts larger = parts_of(x * 0x1p+54);
    return {larger.fraction, larger.exponent - 54.0};
  }
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int exponent = static_cast<int>(bits >> kFraction) - kBias;
  return {std::bit_cast<double>((bits & kFractionMask) | std::bit_cast<std::uint64_t>(1.0)),
          static_cast<double>(exponent)};
}

}  // namespace

double exp(double x) {
  if (std::isnan(x)) return x;
  if (x > kMostExponent) return std::numeric_limits<double>::infinity();
  if (x < kLeastExponent) return 0.0;
  const double count = rounded(x * std::numbers::log2e);
  const Pair r = exact_sum(x - count * kLog2.high, -count * kLog2.low);
  const double series = polynomial(r.high, 1.0 / 6227020800.0, 1.0 / 479001600.0, 1.0 / 39916800.0,
                                   1.0 / 3628800.0, 1.0 / 362880.0, 1.0 / 40320.0, 1.0 / 5040.0, 1.0 / 720.0,
                                   1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5);
  const Pair first = exact_sum_of_ordered(1.0, r.high);
  const double power = first.high + (first.low + (r.high * r.high * series + r.low * first.high));
  const auto exponent = static_cast<int>(count);
  return std::abs(exponent) < 1000 ? power * power_of_two(exponent) : std::ldexp(power, exponent);
}

double log(double x) {
  if (std::isnan(x) || x == std::numeric_limits<double>::infinity()) return x;
  if (x < 0.0) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0.0) return -std::numeric_limits<double>::infinity();
  auto [m, exponent] = parts_of(x);
  if (m > std::numbers::sqrt2) {
    m *= 0.5;
    exponent += 1.0;
  }
  // m = (1 + s) / (1 - s) for s = (m - 1) / (m + 1).
  const Pair sum = exact_sum(m, 1.0);
  const double s = (m - 1.0) / sum.high;
  const Pair back = exact_product(s, sum.high);
  const double missing = (((m - 1.0) - back.high) - back.low - s * sum.low) / sum.high;
  const Pair first = exact_sum(exponent * kLog2.high, 2.0 * s);
  return first.high + (first.low + (rest_of_log(s) + 2.0 * missing + exponent * kLog2.low));
}

double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return std::numeric_limits<double>::infinity();
  if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  const double largest = std::max(std::fabs(x), std::fabs(y));
  if (largest == 0.0) return 0.0;
  // Scaling by a power of two changes no bit and keeps the squares in range.
  const double scale = largest > 0x1p+500 ? 0x1p-600 : largest < 0x1p-400 ? 0x1p+600 : 1.0;
  x *= scale;
  y *= scale;
  const Pair xx = exact_product(x, x);
  const Pair yy = exact_product(y, y);
  const Pair sum = exact_sum(xx.high, yy.high);
  const double root = std::sqrt(sum.high);
  const Pair back = exact_product(root, root);
  const double missing = (sum.high - back.high) - back.low + (sum.low + xx.low + yy.low);
  return (root + missing / (2.0 * root)) / scale;
}

double hypot(double x, double y, double z) { return hypot(hypot(x, y), z); }

}  // namespace orca::portable
