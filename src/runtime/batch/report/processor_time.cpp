// SPDX-License-Identifier: LGPL-3.0-or-later
#include "processor_time.hpp"

#include <cstdio>
#include <set>
#include <string>

#include "orca/batch/lap_times.hpp"

namespace orca::batch {
namespace {

std::string in_ms(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g ms", 1e3 * seconds);
  return text;
}

}  // namespace

void add_processor_time(const Experiment& experiment, const std::vector<Row>& rows, Document& document) {
  LapTimes times;
  for (const Row& row : rows) times.add(row);
  std::set<std::string> components;
  for (const auto& [variant, sums] : times.of_variant)
    for (const auto& [component, sum] : sums) components.insert(component);
  if (components.empty()) return;
  Table table{{"component"}, {}};
  for (const Variant& variant : experiment.variants) table.head.push_back(variant.name);
  for (const std::string& component : components) {
    std::vector<std::string> cells{component};
    for (const Variant& variant : experiment.variants) {
      const LapTimes::Sum& sum = times.of_variant[variant.name][component];
      cells.push_back(sum.laps == 0 ? "" : in_ms(sum.mean()) + " (" + in_ms(sum.longest) + ")");
    }
    table.rows.push_back(std::move(cells));
  }
  document.add(Heading{"Processor time"});
  document.add(std::move(table));
  document.add(Paragraph{
      "Per lap of each component: the mean over all runs, and in brackets the longest. It is that of the "
      "machine that made the "
      "runs, which no other figure on this page depends on, and it differs each time that they are made."});
}

}  // namespace orca::batch
