// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "comparison.hpp"
#include "document.hpp"
#include "orca/batch/experiment.hpp"

namespace orca::batch {

/// Returns the family of each world of an experiment.
[[nodiscard]] std::map<std::string, std::string> families_of(const Experiment& experiment);

/// Returns the sentence about a reversal.
[[nodiscard]] std::string line_of(const Reversal& reversal);

/// Returns what is established in which families about a question that was asked of all worlds: "; by family: VfhPlus is better in harsh,
/// nominal". Nothing if there is nothing, or a reversal, which has its own line.
[[nodiscard]] std::string families_text(const Difference& pooled, const BatchResult& result);

/// Adds what is found in each family of worlds: how often variants succeed, their differences, and how times are distributed. Nothing where
/// no family has runs enough for a claim.
void add_families(const std::vector<Row>& rows, const std::map<std::string, std::string>& families,
                  const BatchResult& result, Document& document);

}  // namespace orca::batch
