// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/finding.hpp"

#include <vector>

namespace orca::batch {
namespace {

constexpr Interval kDifferencesOfShares{-1.0, 1.0};

Result<double> p_of(Test test, const std::vector<double>& values, const SignFlipOptions& options) {
  if (test == Test::student) return student_p(values);
  const Result<SignFlips> flips = sign_flips(values, options);
  return flips ? Result<double>(flips->p) : flips.error();
}

}  // namespace

Result<Finding> find_difference(ValuesByWorld first, ValuesByWorld second, Quantity quantity,
                                const FindingOptions& options) {
  const Result<std::vector<std::vector<double>>> differences = paired_differences(first, second);
  if (!differences) return differences.error();
  const Result<Sample> sample = sample_of(*differences);
  if (!sample) return sample.error();
  Finding finding;
  for (const std::vector<double>& world : *differences) finding.runs += world.size();
  finding.scope = sample->scope;
  const bool is_success = quantity == Quantity::success;
  finding.test = is_success || sample->values.size() >= kFewestFlipped ? Test::sign_flips : Test::student;
  const Result<double> p = p_of(finding.test, sample->values, options.flips);
  const Result<Estimate> difference =
      is_success ? estimate_share(sample->values, kDifferencesOfShares, options.bootstrap)
                 : estimate_mean(sample->values, options.bootstrap);
  if (!p || !difference) return (p ? difference.error() : p.error());
  finding.p = *p;
  finding.difference = *difference;
  return finding;
}

}  // namespace orca::batch
