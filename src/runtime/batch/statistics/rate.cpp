// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/rate.hpp"

#include <cmath>
#include <string>

namespace orca::batch {
namespace {

constexpr double kNormal975 = 1.959963984540054;  // the quantile 0.975 of the standard normal distribution

}  // namespace

Result<Interval> wilson_interval(std::uint64_t successes, std::uint64_t runs) {
  if (runs == 0) return fail(Code::invalid_argument, "there are no runs; a rate needs at least one");
  if (successes > runs)
    return fail(Code::invalid_argument, std::to_string(successes) + " successes in " + std::to_string(runs) +
                                            " runs; expected at most as many as runs");
  const auto n = static_cast<double>(runs);
  const double rate = static_cast<double>(successes) / n;
  const double square = kNormal975 * kNormal975 / n;
  const double centre = (rate + 0.5 * square) / (1.0 + square);
  const double half = std::sqrt(rate * (1.0 - rate) * square + 0.25 * square * square) / (1.0 + square);
  return Interval{successes == 0 ? 0.0 : centre - half, successes == runs ? 1.0 : centre + half};
}

}  // namespace orca::batch
