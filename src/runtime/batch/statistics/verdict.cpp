// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/verdict.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "orca/base/text.hpp"

namespace orca::batch {
namespace {

// Three digits, the same on every machine.
std::string three_digits(double number) {
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::general, 3).ptr;
  return {text.data(), end};
}

Status check_comparison(const Comparison& comparison) {
  if (!(comparison.adjusted_p >= 0.0 && comparison.adjusted_p <= 1.0))
    return fail(Code::invalid_argument, "the adjusted p-value is not a number from 0 to 1");
  const auto [low, high] = comparison.difference;
  if (!std::isfinite(low) || !std::isfinite(high) || low > high)
    return fail(Code::invalid_argument,
                "the interval of the difference needs two finite ends, the lower one first");
  return ok();
}

std::vector<Doubt> doubts_of(const Comparison& comparison) {
  std::vector<Doubt> doubts;
  if (comparison.first_runs < kLeastRuns || comparison.second_runs < kLeastRuns)
    doubts.push_back(Doubt::too_few_runs);
  if (comparison.difference.contains(0.0)) doubts.push_back(Doubt::interval_includes_zero);
  if (comparison.adjusted_p > kLargestPValue) doubts.push_back(Doubt::p_value_too_large);
  return doubts;
}

std::string text_of(Doubt doubt, const Comparison& comparison) {
  switch (doubt) {
    case Doubt::too_few_runs:
      return "too few runs (" + std::to_string(comparison.first_runs) + " and " +
             std::to_string(comparison.second_runs) + ", at least " + std::to_string(kLeastRuns) +
             " of each are needed)";
    case Doubt::interval_includes_zero:
      return "the interval of the difference includes 0 (" + three_digits(comparison.difference.low) +
             " to " + three_digits(comparison.difference.high) + ")";
    case Doubt::p_value_too_large:
      return "the adjusted p-value " + three_digits(comparison.adjusted_p) + " is above " +
             three_digits(kLargestPValue);
  }
  return "?";
}

}  // namespace

Result<Verdict> judge(const Comparison& comparison) {
  if (const Status status = check_comparison(comparison); !status) return status.error();
  const std::vector<Doubt> doubts = doubts_of(comparison);
  if (doubts.empty()) return Verdict{doubts, "difference established"};
  std::vector<std::string> reasons;
  for (const Doubt doubt : doubts) reasons.push_back(text_of(doubt, comparison));
  return Verdict{doubts, "not established: " + joined(reasons, "; ")};
}

}  // namespace orca::batch
