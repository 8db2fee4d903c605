// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::portable {

// A number of about 106 bits: high + low, where low is less than half the last place of high.
struct Pair {
  double high;
  double low;
};

// Returns a + b exactly.
inline Pair exact_sum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

// Returns a + b exactly if |a| >= |b|.
inline Pair exact_sum_of_ordered(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

// Returns a number as two of 26 bits. Below 1e300.
inline Pair halves(double a) {
  constexpr double kSplitter = 134217729.0;  // 2^27 + 1
  const double scaled = kSplitter * a;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

// Returns a * b exactly, if neither overflows nor its last places vanish.
inline Pair exact_product(double a, double b) {
  const double product = a * b;
  const Pair x = halves(a);
  const Pair y = halves(b);
  return {product, ((x.high * y.high - product) + x.high * y.low + x.low * y.high) + x.low * y.low};
}

// Returns the whole number next to a number below 2^51, without a call.
inline double rounded(double a) {
  constexpr double kShift = 0x1.8p+52;  // its last place is 1
  return (a + kShift) - kShift;
}

// Returns a polynomial by Horner's rule, its highest coefficient first.
template <class... Rest>
double polynomial(double x, double first, Rest... rest) {
  double sum = first;
  ((sum = sum * x + rest), ...);
  return sum;
}

}  // namespace orca::portable
