// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/finding.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "moments.hpp"
#include "student.hpp"

namespace orca::batch {
namespace {

constexpr Interval kDifferencesOfShares{-1.0, 1.0};

struct Tester {
  Test test;
  const SignFlipOptions& options;

  [[nodiscard]] Result<double> p_of(const std::vector<double>& values) const {
    if (test == Test::student) return student_p(values);
    const Result<SignFlips> flips = sign_flips(values, options);
    return flips ? Result<double>(flips->p) : flips.error();
  }

  // Returns a small p if the mean of sign * value + margin is above 0.
  [[nodiscard]] Result<double> p_above(double sign, double margin, std::vector<double> values) const {
    for (double& value : values) value = sign * value + margin;
    return mean_of(values) > 0.0 ? p_of(values) : Result<double>(1.0);
  }
};

Result<double> p_of(const Asked& asked, const Tester& tester, const std::vector<double>& values) {
  if (asked.claim == Claim::difference) return tester.p_of(values);
  const double sign = asked.more_is_better ? 1.0 : -1.0;
  const Result<double> p = tester.p_above(sign, asked.margin, values);
  if (!p || asked.claim == Claim::not_worse) return p;
  const Result<double> other = tester.p_above(-sign, asked.margin, values);
  return other ? Result<double>(std::max(*p, *other)) : other;
}

}  // namespace

bool Finding::interval_supports_claim() const {
  const auto [low, high] = difference.interval;
  if (asked.claim == Claim::difference) return !difference.interval.contains(0.0);
  const bool is_above = low > -asked.margin;
  const bool is_below = high < asked.margin;
  if (asked.claim == Claim::equal) return is_above && is_below;
  return asked.more_is_better ? is_above : is_below;
}

bool Finding::interval_contradicts_claim() const {
  const auto [low, high] = difference.interval;
  const bool is_below = high < -asked.margin;
  const bool is_above = low > asked.margin;
  if (asked.claim == Claim::equal) return is_below || is_above;
  return asked.claim == Claim::not_worse && (asked.more_is_better ? is_below : is_above);
}

std::optional<std::size_t> Finding::values_needed() const {
  if (interval_contradicts_claim()) return std::nullopt;
  const double distance = asked.claim == Claim::difference ? std::fabs(difference.value) : asked.margin;
  if (!(spread > 0.0) || distance == 0.0) return std::nullopt;
  constexpr double kOutside = 0.05;                               // of an interval: 2.5 % on each side
  const double misses = asked.claim == Claim::equal ? 0.2 : 0.4;  // two-sided tails of 0.9 and 0.8
  const double square = (spread / distance) * (spread / distance);
  const auto is_enough_of = [&](std::size_t count) {
    const double reach = student_reach(kOutside, count - 1) + student_reach(misses, count - 1);
    return count >= kMostNeeded || static_cast<double>(count) >= reach * reach * square;
  };
  const std::size_t least = test == Test::sign_flips ? kFewestFlipped : kFewestDrawnWorlds;
  std::size_t low = scope.over_worlds() ? least : kLeastRuns;
  std::size_t high = low;
  while (!is_enough_of(high)) high *= 2;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (is_enough_of(middle))
      high = middle;
    else
      low = middle + 1;
  }
  return low;
}

Result<Finding> find_difference(ValuesByWorld first, ValuesByWorld second, Quantity quantity,
                                const Asked& asked, const FindingOptions& options) {
  const Result<std::vector<std::vector<double>>> differences = paired_differences(first, second);
  if (!differences) return differences.error();
  const Result<Sample> sample = sample_of(*differences);
  if (!sample) return sample.error();
  const std::vector<double>& values = sample->values;
  Finding finding{.scope = sample->scope, .asked = asked, .difference = {}};
  for (const std::vector<double>& world : *differences) finding.runs += world.size();
  const bool is_success = quantity == Quantity::success;
  finding.test = is_success || values.size() >= kFewestFlipped ? Test::sign_flips : Test::student;
  const Result<double> p = p_of(asked, {finding.test, options.flips}, values);
  const Result<Estimate> difference = is_success
                                          ? estimate_share(values, kDifferencesOfShares, options.bootstrap)
                                          : estimate_mean(values, options.bootstrap);
  if (!p || !difference) return (p ? difference.error() : p.error());
  finding.p = *p;
  finding.difference = *difference;
  if (values.size() > 1)
    finding.spread = standard_error_of(values) * std::sqrt(static_cast<double>(values.size()));
  return finding;
}

}  // namespace orca::batch
