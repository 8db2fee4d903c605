// SPDX-License-Identifier: GPL-3.0-or-later
// Results whose truth is known, and reports on them.
#pragma once

#include <catch2/catch.hpp>

#include <set>
#include <string>
#include <vector>

#include "orca/batch/report.hpp"
#include "report/comparison.hpp"
#include "temp_folder.hpp"

namespace orca::batch {

// Twenty worlds with one seed each; the first `failures` of them fail, and the others take `time` and more.
inline void add(std::vector<Row>& rows, const std::string& variant, int failures, double time = 60.0) {
  for (int world = 10; world < 30; ++world) {
    Row row{variant, "w" + std::to_string(world), 1, {}, {}};
    const bool fails = world - 10 < failures;
    row.outcome.ending = fails ? Ending::time_out : Ending::success;
    row.outcome.failure = fails ? Failure::trap : Failure::none;
    row.outcome.time = fails ? 200.0 : time + 0.1 * world;
    row.outcome.measures.way = 30.0 + 1e-9 * world;  // no two runs are the same to the last bit
    row.outcome.measures.clearance = 0.2;
    row.outcome.sketch = {"0.00 0.00,1.00 0.50", fails ? "0.50 0.25" : "",
                          "-1.00 -1.00,3.00 -1.00,3.00 2.00"};
    rows.push_back(row);
  }
}

// Makes one world with twenty seeds of the twenty worlds.
void move_into_one_world(std::vector<Row>& rows) {
  for (Row& row : rows) {
    row.seed = std::stoull(row.world.substr(1));
    row.world = "w10";
  }
}

inline Experiment experiment() {
  xml::Diagnostics diagnostics;
  std::string worlds;
  for (int world = 10; world < 30; ++world) worlds += "<world name=\"w" + std::to_string(world) + "\"/>";
  const auto read = read_experiment(
      R"(<experiment name="e" graph="g.xml" seeds="1" until="200 s"><variant name="bad"><set arg="a" value="it's &lt;1&gt;"/></variant><variant name="good"/>)" +
          worlds + "</experiment>",
      "/top/e.xml", diagnostics);
  REQUIRE(read);
  return *read;
}

inline Report report_on(const std::vector<Row>& rows, const Experiment& experiment) {
  const test::TempFolder folder;
  const auto store = Store::open(folder.file("r.sqlite"), "1").value();
  for (const Row& row : rows) REQUIRE(store->add(row).ok());
  const auto made = make_report(experiment, *store);
  REQUIRE(made);
  return *made;
}

inline Report report_on(const std::vector<Row>& rows) { return report_on(rows, experiment()); }

// Returns the questions of an experiment that has these rows and metrics.
inline std::vector<Contrast> pairs_in(const std::vector<Row>& rows, const std::vector<std::string>& metrics) {
  Experiment asks;
  std::set<std::string> variants;
  for (const Row& row : rows) variants.insert(row.variant);
  for (const std::string& variant : variants) asks.variants.push_back({variant, "", {}, {}});
  asks.metrics = metrics;
  return questions_of(asks);
}

inline const Difference& in(const BatchResult& result, const std::string& metric) {
  for (const Difference& one : result.differences)
    if (one.asked.metric == metric) return one;
  FAIL("no difference in " << metric);
  return result.differences.front();
}

}  // namespace orca::batch
