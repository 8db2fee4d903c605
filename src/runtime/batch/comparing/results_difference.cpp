// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/results_difference.hpp"

#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"

namespace orca::batch {
namespace {

using Column = std::pair<std::string, std::string>;  // name and value

std::vector<Column> columns_of(const Outcome& outcome) {
  std::vector<Column> columns{
      {"ending", name_of(outcome.ending)},           {"reason", outcome.reason},
      {"failure", name_of(outcome.failure)},         {"time", xml::number_text(outcome.time)},
      {"goals", std::to_string(outcome.goals)},      {"failed_goals", std::to_string(outcome.failed_goals)},
      {"contacts", std::to_string(outcome.contacts)}};
  for (const Measure& measure : all_measures()) {
    const std::optional<double>& value = outcome.measures.*measure.value;
    columns.emplace_back(measure.name, value ? xml::number_text(*value) : "");
  }
  columns.emplace_back("trace_hash", outcome.trace_hash);
  return columns;
}

}  // namespace

Result<ResultsDifference> compare_results(const Store& first, const Store& second) {
  ResultsDifference found;
  const Status read = first.for_each([&](const Row& row) {
    std::optional<Row> other = second.find(row.variant, row.world, row.seed);
    if (!other) {
      ++found.only_first;
      return;
    }
    ++found.in_both;
    if (row.outcome == other->outcome) return;
    if (++found.different == 1) found.first.emplace(row, *std::move(other));
  });
  if (!read.ok()) return read.error();
  const Status counted = second.for_each([&](const Row& row) {
    if (!first.has(row.variant, row.world, row.seed)) ++found.only_second;
  });
  if (!counted.ok()) return counted.error();
  return found;
}

std::vector<std::string> columns_that_differ(const Outcome& first, const Outcome& second,
                                             const std::string& one, const std::string& other) {
  const auto shown = [](const std::string& value) { return value.empty() ? "empty" : shortened(value, 200); };
  const std::vector<Column> a = columns_of(first);
  const std::vector<Column> b = columns_of(second);
  std::vector<std::string> found;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i] != b[i])
      found.push_back(a[i].first + " is " + shown(a[i].second) + " in " + one + " and " + shown(b[i].second) +
                      " in " + other);
  return found;
}

}  // namespace orca::batch
