// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/verdict.hpp"

#include <array>
#include <charconv>

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

Status check(const Finding& finding, double adjusted_p) {
  if (!(adjusted_p >= 0.0 && adjusted_p <= 1.0))
    return fail(Code::invalid_argument, "the adjusted p-value is not a number from 0 to 1");
  const auto [low, high] = finding.difference.interval;
  if (!(low <= high))
    return fail(Code::invalid_argument, "the interval of the difference needs two ends, the lower one first");
  return ok();
}

// Where there is too little to judge by, what it would look like is no reason more.
std::vector<Doubt> doubts_of(const Finding& finding, double adjusted_p) {
  std::vector<Doubt> doubts;
  if (finding.runs < kLeastRuns) doubts.push_back(Doubt::too_few_runs);
  if (finding.has_too_few_worlds()) doubts.push_back(Doubt::too_few_worlds);
  if (!doubts.empty()) return doubts;
  if (!finding.interval_supports_claim()) doubts.push_back(Doubt::interval_too_wide);
  if (adjusted_p > kLargestPValue) doubts.push_back(Doubt::p_value_too_large);
  return doubts;
}

std::string text_of(Doubt doubt, const Finding& finding, double adjusted_p) {
  switch (doubt) {
    case Doubt::too_few_runs:
      return "too few runs (" + std::to_string(finding.runs) + " of each, at least " +
             std::to_string(kLeastRuns) + " are needed)";
    case Doubt::too_few_worlds:
      return "too few worlds (" + std::to_string(finding.scope.worlds) + ", at least " +
             std::to_string(kFewestFlipped) + " are needed)";
    case Doubt::interval_too_wide:
      if (finding.interval_contradicts_claim())
        return "the whole interval lies beyond the margin, which speaks against the claim";
      return finding.asked.claim == Claim::difference ? "the interval includes 0"
                                                      : "the interval reaches the margin";
    case Doubt::p_value_too_large:
      return "the adjusted p-value " + three_digits(adjusted_p) + " is above " + three_digits(kLargestPValue);
    case Doubt::reversed: break;
  }
  return "?";
}

}  // namespace

bool is_enough(const Finding& finding) { return finding.runs >= kLeastRuns && !finding.has_too_few_worlds(); }

Result<Verdict> judge(const Finding& finding, double adjusted_p) {
  if (const Status status = check(finding, adjusted_p); !status) return status.error();
  const std::vector<Doubt> doubts = doubts_of(finding, adjusted_p);
  if (doubts.empty())
    return Verdict{doubts,
                   (finding.asked.claim == Claim::difference ? "difference established" : "established") +
                       finding.scope.text()};
  std::vector<std::string> reasons;
  for (const Doubt doubt : doubts) reasons.push_back(text_of(doubt, finding, adjusted_p));
  return Verdict{doubts, "not established: " + joined(reasons, "; ")};
}

}  // namespace orca::batch
