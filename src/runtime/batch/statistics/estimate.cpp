// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "input_checks.hpp"
#include "moments.hpp"
#include "normal.hpp"
#include "orca/base/random.hpp"
#include "orca/batch/statistics/rate.hpp"
#include "student.hpp"

namespace orca::batch {
namespace {

constexpr double kOutside = 0.05;  // of an interval

// Returns a number in [0, count), each equally likely, by Lemire's multiplication with rejection (ACM TOMACS 29(1), 2019).
std::size_t drawn_index(RandomStream& random, std::uint32_t count) {
  std::uint64_t product = (random() >> 32) * count;
  if (static_cast<std::uint32_t>(product) < count) {
    const std::uint32_t unfair = (0U - count) % count;
    while (static_cast<std::uint32_t>(product) < unfair) product = (random() >> 32) * count;
  }
  return static_cast<std::size_t>(product >> 32);
}

// Values are taken as differences from the first one: sums of equal values are exact then.
Interval bootstrapped(std::span<const double> values, const BootstrapOptions& options) {
  const double origin = values.front();
  std::vector<double> parts;
  for (const double value : values) parts.push_back(value - origin);
  const auto count = static_cast<std::uint32_t>(parts.size());
  RandomStream random(options.seed, "batch", "bootstrap");
  std::vector<double> means(options.draws);
  for (double& mean : means) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < count; ++i) sum += parts[drawn_index(random, count)];
    mean = origin + sum / count;
  }
  std::ranges::sort(means);
  const double reach = student_reach(kOutside, count - 1) * std::sqrt(count / (count - 1.0));
  const double q = 0.5 * two_sided_normal_tail(reach);
  return {quantile_of_sorted(means, q), quantile_of_sorted(means, 1.0 - q)};
}

Interval students(std::span<const double> values) {
  const double half = student_reach(kOutside, values.size() - 1) * standard_error_of(values);
  const double mean = mean_of(values);
  return {mean - half, mean + half};
}

}  // namespace

double standard_error_of(std::span<const double> values) {
  const double mean = mean_of(values);
  const auto count = static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / (count - 1.0) / count);
}

Result<Estimate> estimate_mean(std::span<const double> values, const BootstrapOptions& options) {
  if (options.draws == 0) return fail(Code::invalid_argument, "a bootstrap needs at least one draw");
  if (const Status status = check_values(values); !status) return status.error();
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  Estimate estimate{mean_of(values), {-kEndless, kEndless}};
  if (values.size() > 1)
    estimate.interval =
        values.size() < kFewestBootstrapped ? students(values) : bootstrapped(values, options);
  return estimate;
}

Result<Estimate> estimate_share(std::span<const double> values, const Interval& limits,
                                const BootstrapOptions& options) {
  Result<Estimate> estimate = estimate_mean(values, options);
  if (!estimate) return estimate;
  Interval& interval = estimate->interval;
  if (interval.low == interval.high) {
    const double more = wilson_interval(0, values.size()).value().high;
    interval = {interval.low - more, interval.high + more};
  }
  interval = {std::max(limits.low, interval.low), std::min(limits.high, interval.high)};
  return estimate;
}

}  // namespace orca::batch
