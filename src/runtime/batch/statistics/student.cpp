// SPDX-License-Identifier: LGPL-3.0-or-later
#include "student.hpp"

#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"

namespace orca::batch {

double two_sided_student_tail(double t, std::size_t freedom) {
  const double slope = std::fabs(t) / std::sqrt(static_cast<double>(freedom));
  const double cosine = 1.0 / portable::hypot(1.0, slope);
  const double sine = std::isinf(slope) ? 1.0 : slope * cosine;
  const bool is_odd = freedom % 2 == 1;
  double term = is_odd ? cosine : 1.0;
  double sum = 0.0;
  for (std::size_t k = is_odd ? 3 : 2; k <= freedom; k += 2) {
    sum += term;
    term *= cosine * cosine * static_cast<double>(k - 1) / static_cast<double>(k);
  }
  const double within =
      is_odd ? 2.0 * std::numbers::inv_pi * (portable::atan2(slope, 1.0) + sine * sum) : sine * sum;
  return std::fmax(0.0, 1.0 - within);
}

double student_reach(double tail, std::size_t freedom) {
  double low = 0.0;
  double high = 1.0;
  while (two_sided_student_tail(high, freedom) > tail) high *= 2.0;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (two_sided_student_tail(middle, freedom) > tail ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace orca::batch
