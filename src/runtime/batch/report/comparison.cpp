// SPDX-License-Identifier: LGPL-3.0-or-later
#include "comparison.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "orca/batch/statistics/holm.hpp"
#include "orca/batch/statistics/summary.hpp"

namespace orca::batch {
namespace {

constexpr Interval kShares{0.0, 1.0};

using Values = std::vector<std::vector<double>>;                               // by world
using Runs = std::map<std::pair<std::string, std::uint64_t>, const Outcome*>;  // by world and seed
using RunsOfVariants = std::map<std::string, Runs>;

// Returns the runs without those that repeat one of an earlier seed or world: they say nothing new. Two worlds in which all is the same
// are one.
Runs distinct(const Runs& runs) {
  std::set<std::string> seen;  // identities
  Runs some;
  for (const auto& [place, outcome] : runs) {
    std::string identity = identity_of(*outcome);
    if (identity.empty() || seen.insert(std::move(identity)).second) some.emplace(place, outcome);
  }
  return some;
}

// Returns the runs without those that repeat an earlier seed of their world.
Runs distinct_in_worlds(const Runs& runs) {
  std::map<std::string, Runs> worlds;
  for (const auto& [place, outcome] : runs) worlds[place.first].emplace(place, outcome);
  Runs some;
  for (const auto& [world, its] : worlds) some.merge(distinct(its));
  return some;
}

Values values_of(const Runs& runs, const Metric& metric) {
  std::map<std::string, std::vector<double>> worlds;
  for (const auto& [place, outcome] : runs)
    if (const std::optional<double> value = metric.of(*outcome)) worlds[place.first].push_back(*value);
  Values values;
  for (auto& [world, of_world] : worlds) values.push_back(std::move(of_world));
  return values;
}

// The values of two variants at the places where both have one.
struct Paired {
  Values first, second;
};

// A place is left out where both variants repeat what they did with an earlier seed, or in another world.
Paired paired(const Runs& some, const Runs& others, const Metric& metric) {
  std::set<std::pair<std::string, std::string>> seen;  // identities of both
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> worlds;
  for (const auto& [place, outcome] : some) {
    const auto other = others.find(place);
    if (other == others.end()) continue;
    const std::string its = identity_of(*outcome);
    const std::string of_other = identity_of(*other->second);
    const bool is_known = !its.empty() && !of_other.empty();
    if (is_known && !seen.emplace(its, of_other).second) continue;
    const std::optional<double> one = metric.of(*outcome);
    const std::optional<double> two = metric.of(*other->second);
    if (!one || !two) continue;
    worlds[place.first].first.push_back(*one);
    worlds[place.first].second.push_back(*two);
  }
  Paired pairs;
  for (auto& [world, values] : worlds) {
    pairs.first.push_back(std::move(values.first));
    pairs.second.push_back(std::move(values.second));
  }
  return pairs;
}

Result<Summary> summary_of(const Values& values, const Metric& metric) {
  std::vector<double> all;
  for (const std::vector<double>& of_world : values) std::ranges::copy(of_world, std::back_inserter(all));
  const Result<Sample> sample = sample_of(values);
  if (!sample) return sample.error();
  Result<Estimate> mean =
      metric.is_success() ? estimate_share(sample->values, kShares) : estimate_mean(sample->values);
  const Result<double> middle = interquartile_mean(all);
  if (!mean || !middle) return (mean ? middle.error() : mean.error());
  if (Interval& interval = mean->interval; std::isfinite(interval.low))  // otherwise it is that of one value
    interval = {std::max(0.0, interval.low), std::min(metric.most, interval.high)};
  return Summary{all.size(), sample->scope, *mean, *middle};
}

Result<VariantResult> result_of(const std::string& name, const Runs& made) {
  const Runs runs = distinct(made);
  VariantResult result{.name = name, .runs = runs.size(), .endings = {}, .failures = {}};
  for (const auto& [place, outcome] : runs) {
    ++result.endings[outcome->ending];
    ++result.failures[outcome->failure];
    if (outcome->measures.claimed_wrongly.value_or(0.0) > 0.0) ++result.claim_wrongly;
    if (outcome->measures.not_claimed.value_or(0.0) > 0.0) ++result.do_not_claim;
  }
  for (const Metric& metric : all_metrics()) {
    const Values values = values_of(runs, metric);
    if (values.empty()) continue;
    Result<Summary> summary = summary_of(values, metric);
    if (!summary) return summary.error();
    result.metrics[metric.name] = *summary;
  }
  return result;
}

// Returns nothing where the two have no pair.
Result<std::optional<Difference>> difference_of(const RunsOfVariants& runs, const Contrast& contrast,
                                                const Metric& metric) {
  const auto first = runs.find(contrast.first);
  const auto second = runs.find(contrast.second);
  if (first == runs.end() || second == runs.end()) return std::optional<Difference>();
  const Paired pairs = paired(first->second, second->second, metric);
  if (pairs.first.empty()) return std::optional<Difference>();
  const Quantity quantity = metric.is_success() ? Quantity::success : Quantity::number;
  const Result<Finding> finding = find_difference(pairs.first, pairs.second, quantity, contrast.asked);
  if (!finding) return finding.error();
  Difference found{.asked = contrast, .finding = *finding, .verdict = {}};
  found.adjusted_p = finding->p;
  const Result<double> larger = probability_of_improvement(pairs.first, pairs.second);
  if (!larger) return larger.error();
  found.improvement = metric.more_is_better ? *larger : 1.0 - *larger;
  return std::optional(found);
}

// Adjusts the p-values for the number of tests that could find something, and judges.
Status judge_all(const std::vector<Difference*>& differences) {
  std::vector<double> p_values;
  for (const Difference* one : differences)
    if (is_enough(one->finding)) p_values.push_back(one->finding.p);
  const Result<std::vector<double>> adjusted = holm(p_values);
  if (!adjusted) return adjusted.error();
  auto next = adjusted->begin();
  for (Difference* one : differences) {
    one->adjusted_p = is_enough(one->finding) ? *next++ : one->finding.p;
    Result<Verdict> verdict = judge(one->finding, one->adjusted_p);
    if (!verdict) return verdict.error();
    one->verdict = *std::move(verdict);
  }
  return ok();
}

// Returns what is found, without verdicts.
Result<std::vector<Difference>> differences_of(const RunsOfVariants& runs,
                                               const std::vector<Contrast>& contrasts) {
  std::vector<Difference> differences;
  for (const Contrast& contrast : contrasts) {
    const Metric* const metric = find_metric(contrast.metric);
    if (metric == nullptr)
      return fail(Code::invalid_argument, "there is no metric \"" + contrast.metric + "\"");
    Result<std::optional<Difference>> found = difference_of(runs, contrast, *metric);
    if (!found) return found.error();
    if (*found) differences.push_back(*std::move(*found));
  }
  return differences;
}

bool is_answered(const Contrast& contrast, const BatchResult& result) {
  return std::ranges::any_of(result.differences,
                             [&](const Difference& one) { return one.asked.text() == contrast.text(); });
}

// Returns in which worlds how many seeds of a variant gave fewer runs.
std::map<std::pair<std::size_t, std::size_t>, std::vector<std::string>> repeated_worlds(const Runs& runs) {
  std::map<std::string, std::size_t> seeds;
  std::map<std::string, std::size_t> different;
  for (const auto& [place, outcome] : runs) ++seeds[place.first];
  for (const auto& [place, outcome] : distinct(runs)) ++different[place.first];
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::string>> worlds;
  for (const auto& [world, count] : seeds)
    if (different[world] < count) worlds[{count, different[world]}].push_back(world);
  return worlds;
}

std::vector<SameRuns> same_runs_of(const RunsOfVariants& runs) {
  std::vector<SameRuns> all;
  for (const auto& [name, its] : runs) {
    for (auto& [counts, worlds] : repeated_worlds(its)) {
      const SameRuns one{{}, worlds, counts.first, counts.second};
      const auto known = std::ranges::find_if(all, [&](const SameRuns& other) {
        return other.worlds == one.worlds && other.seeds == one.seeds && other.runs == one.runs;
      });
      (known == all.end() ? all.emplace_back(one) : *known).variants.push_back(name);
    }
  }
  return all;
}

void count_successes(const RunsOfVariants& runs, BatchResult& result) {
  for (const auto& [name, its] : runs) {
    for (const auto& [place, outcome] : distinct_in_worlds(its)) {
      auto& [successes, count] = result.matrix[{name, place.first}];
      ++count;
      if (outcome->ending == Ending::success) ++successes;
    }
  }
}

std::vector<Difference*> pointers_to(std::vector<Difference>& differences) {
  std::vector<Difference*> pointers;
  for (Difference& one : differences) pointers.push_back(&one);
  return pointers;
}

Result<FamilyResult> family_of(const std::string& name, const RunsOfVariants& runs,
                               const Question& question) {
  FamilyResult family{.name = name, .success = {}, .differences = {}};
  std::set<std::string> worlds;
  for (const auto& [variant, its] : runs) {
    for (const auto& [place, outcome] : its) worlds.insert(place.first);
    const Metric& success = *find_metric("success");
    Result<Summary> summary = summary_of(values_of(distinct(its), success), success);
    if (!summary) return summary.error();
    family.success[variant] = *summary;
  }
  family.worlds = worlds.size();
  Result<std::vector<Difference>> differences = differences_of(runs, question.contrasts);
  if (!differences) return differences.error();
  family.differences = *std::move(differences);
  return family;
}

// The tests of all families are one set for Holm's correction, beside that of all worlds together.
Result<std::vector<FamilyResult>> families_of(const RunsOfVariants& runs, const Question& question) {
  std::map<std::string, RunsOfVariants> by_family;
  for (const auto& [variant, its] : runs)
    for (const auto& [place, outcome] : its)
      if (const auto known = question.families.find(place.first); known != question.families.end())
        by_family[known->second][variant].emplace(place, outcome);
  std::vector<FamilyResult> families;
  if (by_family.size() < 2) return families;
  for (const auto& [name, its] : by_family) {
    Result<FamilyResult> family = family_of(name, its, question);
    if (!family) return family.error();
    families.push_back(*std::move(family));
  }
  std::vector<Difference*> all;
  for (FamilyResult& family : families)
    std::ranges::copy(pointers_to(family.differences), std::back_inserter(all));
  if (const Status judged = judge_all(all); !judged.ok()) return judged.error();
  return families;
}

// Returns the family in which the difference that a question asks for is established with this sign, and the surest of them.
std::optional<std::pair<std::string, Difference>> surest(const std::vector<FamilyResult>& families,
                                                         const Difference& question, bool positive) {
  std::optional<std::pair<std::string, Difference>> best;
  for (const FamilyResult& family : families)
    for (const Difference& one : family.differences)
      if (same_question(one, question) && one.verdict.established() &&
          (one.finding.difference.value > 0.0) == positive &&
          (!best || one.adjusted_p < best->second.adjusted_p))
        best = {family.name, one};
  return best;
}

// Finds what the families contradict each other in, and takes back what is claimed of all worlds together.
void find_reversals(BatchResult& result) {
  for (Difference& pooled : result.differences) {
    if (pooled.finding.asked.claim != Claim::difference) continue;
    const auto more = surest(result.families, pooled, true);
    const auto less = surest(result.families, pooled, false);
    if (!more || !less) continue;
    result.reversals.push_back({more->second, less->second, more->first, less->first});
    pooled.verdict = {{Doubt::reversed}, "not claimed: families of worlds contradict each other"};
  }
}

}  // namespace

std::string identity_of(const Outcome& outcome) {
  if (outcome.measures.way.value_or(0.0) <= 0.0) return outcome.trace_hash;
  Outcome motion = outcome;
  motion.reason.clear();
  motion.trace_hash.clear();
  return to_text(motion);
}

bool same_question(const Difference& one, const Difference& other) {
  return one.asked.text() == other.asked.text();
}

Result<BatchResult> compare(const std::vector<Row>& rows, const Question& question) {
  BatchResult result;
  RunsOfVariants runs;
  std::set<std::string> worlds;
  for (const Row& row : rows) {
    runs[row.variant][{row.world, row.seed}] = &row.outcome;
    worlds.insert(row.world);
  }
  result.worlds.assign(worlds.begin(), worlds.end());
  count_successes(runs, result);
  result.same_runs = same_runs_of(runs);
  for (const auto& [name, its] : runs) {
    Result<VariantResult> variant = result_of(name, its);
    if (!variant) return variant.error();
    result.variants.push_back(*std::move(variant));
  }
  Result<std::vector<Difference>> differences = differences_of(runs, question.contrasts);
  if (!differences) return differences.error();
  result.differences = *std::move(differences);
  if (const Status judged = judge_all(pointers_to(result.differences)); !judged.ok()) return judged.error();
  for (const Contrast& contrast : question.contrasts)
    if (runs.contains(contrast.first) && runs.contains(contrast.second) && !is_answered(contrast, result))
      result.unanswered.push_back(contrast);
  Result<std::vector<FamilyResult>> families = families_of(runs, question);
  if (!families) return families.error();
  result.families = *std::move(families);
  find_reversals(result);
  return result;
}

}  // namespace orca::batch
