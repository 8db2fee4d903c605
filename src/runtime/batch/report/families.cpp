// SPDX-License-Identifier: LGPL-3.0-or-later
#include "families.hpp"

#include <algorithm>
#include <utility>

#include "numbers.hpp"
#include "orca/base/text.hpp"
#include "plots.hpp"

namespace orca::batch {
namespace {

std::string in_family(const Difference& difference, const std::string& family, const Metric& metric) {
  return "in " + family + ", " + estimate_text(difference.finding.difference, metric);
}

bool has_enough(const FamilyResult& family) {
  return std::ranges::any_of(family.differences,
                             [](const Difference& one) { return is_enough(one.finding); });
}

Table success_table(const BatchResult& result) {
  Table table{{"family", "worlds"}, {}};
  for (const VariantResult& variant : result.variants) table.head.push_back(variant.name);
  const Metric& metric = *find_metric("success");
  for (const FamilyResult& family : result.families) {
    std::vector<std::string> row{family.name, std::to_string(family.worlds)};
    for (const VariantResult& variant : result.variants) {
      const auto found = family.success.find(variant.name);
      row.push_back(found == family.success.end() ? "" : estimate_text(found->second.mean, metric));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

// The families of one question stand one below the other.
Table claims_table(const BatchResult& result) {
  Table table{{"metric", "question", "family", "claim", "difference (95 %)", "p", "test", "pairs"}, {}};
  for (const Difference& pooled : result.differences) {
    const Metric& metric = *find_metric(pooled.asked.metric);
    for (const FamilyResult& family : result.families)
      for (const Difference& one : family.differences)
        if (same_question(one, pooled) && is_enough(one.finding))
          table.rows.push_back({title_of(metric), question_text(one.asked), family.name, claim_text(one),
                                estimate_text(one.finding.difference, metric), p_text(one.adjusted_p),
                                test_text(one.finding), std::to_string(one.finding.runs)});
  }
  return table;
}

// Returns the times of a family's successes; nothing if there are none.
std::vector<Series> times_in(const std::string& family, const std::vector<Row>& rows,
                             const std::map<std::string, std::string>& families, const BatchResult& result) {
  std::vector<Series> times;
  bool has_any = false;
  for (const VariantResult& variant : result.variants) {
    Series series{variant.name, {}, 0};
    for (const Row& row : rows) {
      const auto known = families.find(row.world);
      if (row.variant != variant.name || known == families.end() || known->second != family) continue;
      ++series.runs;
      if (row.outcome.ending == Ending::success) series.values.push_back(row.outcome.time);
    }
    has_any = has_any || !series.values.empty();
    if (series.runs > 0) times.push_back(std::move(series));
  }
  return has_any ? times : std::vector<Series>();
}

}  // namespace

std::map<std::string, std::string> families_of(const Experiment& experiment) {
  std::map<std::string, std::string> families;
  for (const World& world : experiment.worlds) families[world.name] = world.family;
  return families;
}

std::string line_of(const Reversal& reversal) {
  const Metric& metric = *find_metric(reversal.more.asked.metric);
  const std::string more = in_family(reversal.more, reversal.more_family, metric);
  const std::string less = in_family(reversal.less, reversal.less_family, metric);
  return "Reversal in " + metric.name + ": " + reversal.more.asked.first + " is better than " +
         reversal.more.asked.second + " " + (metric.more_is_better ? more : less) + ", and worse " +
         (metric.more_is_better ? less : more) + "; nothing is claimed about all worlds together";
}

std::string families_text(const Difference& pooled, const BatchResult& result) {
  std::map<std::string, std::vector<std::string>> families;  // by statement
  for (const FamilyResult& family : result.families)
    for (const Difference& one : family.differences)
      if (same_question(one, pooled) && one.verdict.established())
        families[statement_of(one)].push_back(family.name);
  if (families.size() != 1) return {};  // two are a reversal
  const auto& [statement, names] = *families.begin();
  return "; by family: " + statement + " in " + listed(names);
}

void add_families(const std::vector<Row>& rows, const std::map<std::string, std::string>& families,
                  const BatchResult& result, Document& document) {
  if (std::ranges::none_of(result.families, has_enough)) return;
  document.add(Heading{"Family by family"});
  document.add(Paragraph{
      "Worlds of one kind are a family. A difference that holds in one family need not hold in another. "
      "Success, with intervals of 95 %:"});
  document.add(success_table(result));
  document.add(Paragraph{
      "Differences where a family has runs and worlds enough for a claim. Their p-values are adjusted "
      "together for all families."});
  document.add(claims_table(result));
  for (const FamilyResult& family : result.families)
    if (const std::vector<Series> times = times_in(family.name, rows, families, result);
        has_enough(family) && !times.empty())
      document.add(Figure{{distribution_plot("time until the last goal [s]", times)},
                          "Family " + family.name + ": share of the runs that were done by then."});
}

}  // namespace orca::batch
