// SPDX-License-Identifier: LGPL-3.0-or-later
#include "numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/batch/statistics/summary.hpp"

namespace orca::batch {
namespace {

constexpr double kAtOnce = 0.1;  // [s] in which no robot gets anywhere

std::string formatted(const char* format, double value) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string span_text(const Interval& interval, const Metric& metric) {
  return value_text(interval.low, metric) + " to " + value_text(interval.high, metric);
}

std::string counted(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

// Counts by what is planned, so that many worlds with the same plan are one line.
std::vector<std::string> lines_of_absent_failures(const Experiment& experiment,
                                                  const std::vector<Row>& rows) {
  std::map<std::string, const World*> worlds;
  for (const World& world : experiment.worlds) worlds[world.name] = &world;
  std::map<std::string, std::pair<std::size_t, std::size_t>> counts;  // runs without it, and all
  for (const Row& row : rows) {
    const auto world = worlds.find(row.world);
    if (world == worlds.end()) continue;
    for (const Failing& one : world->second->failing) {
      auto& [without, all] = counts[one.text()];
      ++all;
      if (to_seconds(one.time(row.seed)) >= row.outcome.time) ++without;
    }
  }
  std::vector<std::string> lines;
  for (const auto& [plan, count] : counts)
    if (count.first > 0)
      lines.push_back("the failure " + plan + " did not come in " + std::to_string(count.first) + " of " +
                      counted(count.second, "run") + ", which ended before");
  return lines;
}

// Who compares two variants that are the same to the last bit learns that a setting does nothing, and not that runs are too few.
std::vector<std::string> lines_of_same_variants(const std::vector<Row>& rows) {
  using Identities = std::map<std::pair<std::string, std::uint64_t>, std::string>;  // by world and seed
  std::map<std::string, Identities> variants;
  for (const Row& row : rows) variants[row.variant][{row.world, row.seed}] = identity_of(row.outcome);
  std::map<Identities, std::vector<std::string>> groups;
  for (auto& [variant, runs] : variants)
    if (std::ranges::none_of(runs, [](const auto& run) { return run.second.empty(); }))
      groups[std::move(runs)].push_back(variant);
  std::vector<std::string> lines;
  for (const auto& [runs, names] : groups)
    if (names.size() > 1)
      lines.push_back(listed(names) + " made the same " + counted(runs.size(), "run") +
                      ": what sets them apart did nothing there");
  return lines;
}

// Runs that fail for one reason, which may lie in the experiment or its graphs and not in what is compared.
std::vector<std::string> lines_of_reasons(const std::vector<Row>& rows) {
  constexpr std::size_t kMostReasons = 3;
  struct Reason {
    std::string text;
    const Row* first;
    std::size_t count;
  };
  std::vector<Reason> reasons;
  for (const Row& row : rows) {
    if (row.outcome.reason.empty()) continue;
    const auto known = std::ranges::find(reasons, row.outcome.reason, &Reason::text);
    if (known == reasons.end())
      reasons.push_back({row.outcome.reason, &row, 1});
    else
      ++known->count;
  }
  std::ranges::stable_sort(reasons, std::greater{}, &Reason::count);
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < std::min(reasons.size(), kMostReasons); ++i)
    lines.push_back("why " + counted(reasons[i].count, "run") + " failed (first " +
                    reasons[i].first->variant + " in " + reasons[i].first->world + ", seed " +
                    std::to_string(reasons[i].first->seed) + "): " + reasons[i].text);
  if (reasons.size() > kMostReasons)
    lines.push_back("other runs failed for " + counted(reasons.size() - kMostReasons, "more reason") +
                    ": see the report");
  return lines;
}

}  // namespace

std::string value_text(double value, const Metric& metric) {
  if (metric.is_success()) return formatted("%.1f %%", 100.0 * value + 0.0);
  return formatted(std::fabs(value) < 10.0 ? "%.3f" : "%.1f", value);
}

std::string estimate_text(const Estimate& estimate, const Metric& metric) {
  if (std::isinf(estimate.interval.low)) return value_text(estimate.value, metric) + " (of one)";
  return value_text(estimate.value, metric) + " (" + span_text(estimate.interval, metric) + ")";
}

std::string spread_text(const std::vector<double>& values, const Metric& metric) {
  const Result<double> middle = mean(values);
  if (!middle) return {};
  const auto [low, high] = std::ranges::minmax(values);
  return value_text(*middle, metric) + " (" + span_text({low, high}, metric) + ")";
}

std::string p_text(double p) { return p < 1e-4 ? "< 0.0001" : formatted("%.4f", p); }

std::string title_of(const Metric& metric) {
  return metric.unit.empty() ? metric.name : metric.name + " [" + metric.unit + "]";
}

std::string false_words_of(const VariantResult& variant) {
  const auto in_runs = [](std::size_t count) {
    return " in " + std::to_string(count) + (count == 1 ? " run" : " runs");
  };
  std::string text;
  if (variant.claim_wrongly > 0) text = "claims goals wrongly" + in_runs(variant.claim_wrongly);
  if (variant.do_not_claim > 0)
    text += (text.empty() ? "" : ", ") + std::string("does not claim goals that it reached") +
            in_runs(variant.do_not_claim);
  return text;
}

std::string scope_text(const Scope& scope) {
  return scope.over_worlds() ? "over worlds" : "over seeds," + scope.text();
}

std::string question_text(const Contrast& contrast) {
  const std::string pair = contrast.first + " - " + contrast.second;
  if (contrast.asked.claim == Claim::difference) return pair;
  return pair + (contrast.asked.claim == Claim::equal ? ", equal within " : ", not worse by ") +
         contrast.margin;
}

std::string statement_of(const Difference& difference) {
  const Contrast& asked = difference.asked;
  switch (asked.asked.claim) {
    case Claim::not_worse: return asked.first + " is not worse than " + asked.second + " by " + asked.margin;
    case Claim::equal: return asked.first + " and " + asked.second + " are equal within " + asked.margin;
    case Claim::difference: break;
  }
  const bool more = difference.finding.difference.value > 0.0;
  return (more == find_metric(asked.metric)->more_is_better ? asked.first : asked.second) + " is better";
}

std::string claim_text(const Difference& difference) {
  const std::string& text = difference.verdict.text;
  if (difference.verdict.established()) return text + ": " + statement_of(difference);
  return difference.asked.asked.claim == Claim::difference ? text
                                                           : text + " (" + statement_of(difference) + ")";
}

std::string needed_text(const Finding& finding) {
  const std::optional<std::size_t> needed = finding.values_needed();
  if (!needed) return {};
  return (*needed >= kMostNeeded ? "more than " : "") +
         counted(*needed, finding.scope.over_worlds() ? "world" : "run");
}

std::string test_text(const Finding& finding) {
  const std::string test = finding.test == Test::student ? "t" : "sign flips";
  return test + ", " +
         (finding.scope.over_worlds() ? counted(finding.scope.worlds, "world")
                                      : counted(finding.runs, "run"));
}

std::string line_of(const SameRuns& same, std::size_t variants) {
  const std::string worlds =
      same.worlds.size() == 1 ? "world " + same.worlds.front() : "each of the worlds " + listed(same.worlds);
  const std::string whose = same.variants.size() == variants ? "" : " of " + listed(same.variants);
  if (same.runs == 0) return "all runs" + whose + " in " + worlds + " repeat those in another world";
  return counted(same.seeds, "seed") + " gave " + counted(same.runs, "run") + whose + " in " + worlds +
         (same.runs == 1 ? ": no seed changed how the robots drove" : ": the other seeds repeat these");
}

std::string line_of(const VariantResult& variant) {
  const Summary& success = variant.metrics.at("success");
  std::string text = variant.name + ": " + counted(variant.runs, "run") + ", " +
                     estimate_text(success.mean, *find_metric("success")) + " succeed (95 % " +
                     scope_text(success.scope) + ")";
  for (const auto& [ending, count] : variant.endings)
    if (ending != Ending::success) text += ", " + std::to_string(count) + " " + name_of(ending);
  if (const std::string words = false_words_of(variant); !words.empty()) text += "; " + words;
  return text;
}

std::string line_of(const Difference& difference) {
  const Metric& metric = *find_metric(difference.asked.metric);
  return difference.asked.first + " - " + difference.asked.second + ", " + title_of(metric) + ": " +
         estimate_text(difference.finding.difference, metric) + ", " + claim_text(difference);
}

std::string line_of(const Contrast& unanswered) {
  return question_text(unanswered) + ", " + title_of(*find_metric(unanswered.metric)) +
         ": no answer, since in no world and seed both have a value";
}

std::vector<std::string> lines_on_runs(const Experiment& experiment, const std::vector<Row>& rows,
                                       const BatchResult& result) {
  std::vector<std::string> lines;
  for (const SameRuns& same : result.same_runs) lines.push_back(line_of(same, result.variants.size()));
  std::ranges::copy(lines_of_same_variants(rows), std::back_inserter(lines));
  std::ranges::copy(lines_of_absent_failures(experiment, rows), std::back_inserter(lines));
  std::ranges::copy(lines_of_reasons(rows), std::back_inserter(lines));
  const auto at_once = std::ranges::count_if(rows, [](const Row& row) {
    return row.outcome.ending == Ending::success && row.outcome.time < kAtOnce;
  });
  if (at_once > 0)
    lines.push_back("all goals were reached at once in " + counted(static_cast<std::size_t>(at_once), "run") +
                    ": do they lie where the robots start?");
  return lines;
}

}  // namespace orca::batch
