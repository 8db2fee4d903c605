// SPDX-License-Identifier: LGPL-3.0-or-later
#include "comparison.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "orca/batch/statistics/holm.hpp"
#include "orca/batch/statistics/mcnemar.hpp"
#include "orca/batch/statistics/rate.hpp"
#include "orca/batch/statistics/summary.hpp"
#include "orca/batch/statistics/wilcoxon.hpp"

namespace orca::batch {
namespace {

using Values = std::vector<std::vector<double>>;                               // by world
using Runs = std::map<std::pair<std::string, std::uint64_t>, const Outcome*>;  // by world and seed
using RunsOfVariants = std::map<std::string, Runs>;

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
  std::vector<double> all_first, all_second;
};

Paired paired(const Runs& some, const Runs& others, const Metric& metric) {
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> worlds;
  for (const auto& [place, outcome] : some) {
    const auto other = others.find(place);
    if (other == others.end()) continue;
    const std::optional<double> one = metric.of(*outcome);
    const std::optional<double> two = metric.of(*other->second);
    if (!one || !two) continue;
    worlds[place.first].first.push_back(*one);
    worlds[place.first].second.push_back(*two);
  }
  Paired pairs;
  for (auto& [world, values] : worlds) {
    std::ranges::copy(values.first, std::back_inserter(pairs.all_first));
    std::ranges::copy(values.second, std::back_inserter(pairs.all_second));
    pairs.first.push_back(std::move(values.first));
    pairs.second.push_back(std::move(values.second));
  }
  return pairs;
}

Result<Summary> summary_of(const Values& values) {
  std::vector<double> all;
  for (const std::vector<double>& of_world : values) std::ranges::copy(of_world, std::back_inserter(all));
  Result<Estimate> mean = bootstrap_mean(values);
  if (!mean) return mean.error();
  const Result<double> middle = interquartile_mean(all);
  if (!middle) return middle.error();
  return Summary{all.size(), *mean, *middle};
}

Result<VariantResult> result_of(const std::string& name, const Runs& runs) {
  VariantResult result{.name = name, .runs = runs.size(), .endings = {}, .failures = {}, .success_rate = {}};
  for (const auto& [place, outcome] : runs) {
    ++result.endings[outcome->ending];
    ++result.failures[outcome->failure];
    if (outcome->measures.claimed_wrongly.value_or(0.0) > 0.0) ++result.claim_wrongly;
    if (outcome->measures.not_claimed.value_or(0.0) > 0.0) ++result.do_not_claim;
  }
  const Result<Interval> rate = wilson_interval(result.endings[Ending::success], runs.size());
  if (!rate) return rate.error();
  result.success_rate = *rate;
  for (const Metric& metric : all_metrics()) {
    const Values values = values_of(runs, metric);
    if (values.empty()) continue;
    Result<Summary> summary = summary_of(values);
    if (!summary) return summary.error();
    result.metrics[metric.name] = *summary;
  }
  return result;
}

// Returns the p-value of McNemar's test of two lists of 0 and 1.
double p_of_success(const Paired& pairs) {
  std::uint64_t only_first = 0;
  std::uint64_t only_second = 0;
  for (std::size_t i = 0; i < pairs.all_first.size(); ++i) {
    if (pairs.all_first[i] > pairs.all_second[i]) ++only_first;
    if (pairs.all_first[i] < pairs.all_second[i]) ++only_second;
  }
  return mcnemar(only_first, only_second).p;
}

Result<double> p_of(const Paired& pairs, const Metric& metric, bool by_worlds) {
  if (metric.is_success()) return p_of_success(pairs);
  if (!by_worlds) {
    const Result<Wilcoxon> test = wilcoxon(pairs.all_first, pairs.all_second);
    return test ? Result<double>(test->p) : test.error();
  }
  const Result<std::vector<double>> first = world_means(pairs.first);
  const Result<std::vector<double>> second = world_means(pairs.second);
  if (!first || !second) return (first ? second : first).error();
  const Result<Wilcoxon> test = wilcoxon(*first, *second);
  return test ? Result<double>(test->p) : test.error();
}

// Returns nothing where the two have no pair.
Result<std::optional<Difference>> difference_of(const RunsOfVariants& runs, const std::string& first,
                                                const std::string& second, const Metric& metric) {
  const Paired pairs = paired(runs.at(first), runs.at(second), metric);
  if (pairs.first.empty()) return std::optional<Difference>();
  Difference found{.first = first, .second = second, .metric = metric.name, .difference = {}, .verdict = {}};
  found.pairs = pairs.all_first.size();
  found.by_worlds = !metric.is_success() && pairs.first.size() >= kLeastWorlds;
  const Result<Estimate> difference = bootstrap_difference(pairs.first, pairs.second);
  if (!difference) return difference.error();
  found.difference = *difference;
  const Result<double> p = p_of(pairs, metric, found.by_worlds);
  if (!p) return p.error();
  found.p = *p;
  const Result<double> larger = probability_of_improvement(pairs.first, pairs.second);
  if (!larger) return larger.error();
  found.improvement = metric.more_is_better ? *larger : 1.0 - *larger;
  return std::optional(found);
}

// Adjusts the p-values for their number, and judges.
Status judge_all(std::vector<Difference>& differences) {
  std::vector<double> p_values;
  for (const Difference& one : differences) p_values.push_back(one.p);
  const Result<std::vector<double>> adjusted = holm(p_values);
  if (!adjusted) return adjusted.error();
  for (std::size_t i = 0; i < differences.size(); ++i) {
    Difference& one = differences[i];
    one.p = (*adjusted)[i];
    Result<Verdict> verdict = judge({one.pairs, one.pairs, one.p, one.difference.interval});
    if (!verdict) return verdict.error();
    one.verdict = *std::move(verdict);
  }
  return ok();
}

Result<std::vector<Difference>> differences_of(const RunsOfVariants& runs,
                                               const std::vector<std::string>& compared) {
  std::vector<Difference> differences;
  for (const std::string& name : compared) {
    const Metric* const metric = find_metric(name);
    if (metric == nullptr) return fail(Code::invalid_argument, "there is no metric \"" + name + "\"");
    for (auto first = runs.begin(); first != runs.end(); ++first) {
      for (auto second = std::next(first); second != runs.end(); ++second) {
        Result<std::optional<Difference>> found = difference_of(runs, first->first, second->first, *metric);
        if (!found) return found.error();
        if (*found) differences.push_back(*std::move(*found));
      }
    }
  }
  if (const Status judged = judge_all(differences); !judged.ok()) return judged.error();
  return differences;
}

}  // namespace

Result<BatchResult> compare(const std::vector<Row>& rows, const std::vector<std::string>& compared) {
  BatchResult result;
  RunsOfVariants runs;
  std::set<std::string> worlds;
  for (const Row& row : rows) {
    runs[row.variant][{row.world, row.seed}] = &row.outcome;
    worlds.insert(row.world);
    auto& [successes, count] = result.matrix[{row.variant, row.world}];
    ++count;
    if (row.outcome.ending == Ending::success) ++successes;
  }
  result.worlds.assign(worlds.begin(), worlds.end());
  for (const auto& [name, its] : runs) {
    Result<VariantResult> variant = result_of(name, its);
    if (!variant) return variant.error();
    result.variants.push_back(*std::move(variant));
  }
  Result<std::vector<Difference>> differences = differences_of(runs, compared);
  if (!differences) return differences.error();
  result.differences = *std::move(differences);
  return result;
}

}  // namespace orca::batch
