// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "comparison.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/store.hpp"

namespace orca::batch {

/// Returns a value of a metric for people, to three digits or more: success as "98.3 %", others without their unit.
[[nodiscard]] std::string value_text(double value, const Metric& metric);
/// Returns "80.4 (79.9 to 81.0)", or "80.4 (of one)" of a value that has no interval.
[[nodiscard]] std::string estimate_text(const Estimate& estimate, const Metric& metric);
/// Returns the mean with the smallest and the largest value, "80.4 (78.1 to 83.0)"; nothing if there are none.
[[nodiscard]] std::string spread_text(const std::vector<double>& values, const Metric& metric);
/// Returns "0.012", or "< 0.0001".
[[nodiscard]] std::string p_text(double p);
/// Returns "time [s]".
[[nodiscard]] std::string title_of(const Metric& metric);
/// Returns what a variant's components said of its goals and was not so, for instance "claims goals wrongly in 3 runs"; empty: all
/// they said was so.
[[nodiscard]] std::string false_words_of(const VariantResult& variant);
/// Returns "over worlds", or over which runs where there are few.
[[nodiscard]] std::string scope_text(const Scope& scope);
/// Returns "VfhPlus - LaserAvoid", with what is asked if that is no difference: "VfhPlus - LaserAvoid, not worse by 2 s".
[[nodiscard]] std::string question_text(const Contrast& contrast);
/// Returns "Dwa is not worse than LaserAvoid by 2 s": what a question claims, or which variant is better.
[[nodiscard]] std::string statement_of(const Difference& difference);
/// Returns the verdict with what it says: "difference established in this world: narrow is better".
[[nodiscard]] std::string claim_text(const Difference& difference);
/// Returns "25 worlds", or "25 runs" where the worlds are fixed: Finding::values_needed(); nothing if that is not known.
[[nodiscard]] std::string needed_text(const Finding& finding);
/// Returns "sign flips, 20 worlds".
[[nodiscard]] std::string test_text(const Finding& finding);
/// Returns the sentence about seeds that change nothing.
[[nodiscard]] std::string line_of(const SameRuns& same, std::size_t variants);
/// Returns a line for the terminal on a variant, and one on a difference.
[[nodiscard]] std::string line_of(const VariantResult& variant);
[[nodiscard]] std::string line_of(const Difference& difference);
/// Returns the line for a question that has no answer.
[[nodiscard]] std::string line_of(const Contrast& unanswered);

/// Returns sentences on seeds, worlds and variants that change nothing, on the failures that an experiment plans and that did not come, because
/// runs ended before, why runs failed, and on goals that were reached at once.
[[nodiscard]] std::vector<std::string> lines_on_runs(const Experiment& experiment,
                                                     const std::vector<Row>& rows, const BatchResult& result);

}  // namespace orca::batch
