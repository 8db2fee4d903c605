// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/batch/store.hpp"

namespace orca::batch {

/// The difference between the results of two batches. A plain value.
struct ResultsDifference {
  std::size_t in_both = 0;                     ///< Runs of the same variant, world and seed.
  std::size_t different = 0;                   ///< Those of them with another outcome.
  std::size_t only_first = 0;                  ///< Runs that the second batch does not have.
  std::size_t only_second = 0;                 ///< Runs that the first batch does not have.
  std::optional<std::pair<Row, Row>> first{};  ///< The first run with another outcome, in both batches.

  [[nodiscard]] bool is_empty() const { return different + only_first + only_second == 0; }
};

/// Compares the results of two batches run by run, in the order of variant, world and seed. Wall and processor times and
/// tracks do not count.
/// @errors  those of the stores.
/// @thread  one thread, which may use both.
[[nodiscard]] Result<ResultsDifference> compare_results(const Store& first, const Store& second);

/// Returns each column in which two outcomes differ: "time is 12.5 in ONE and 13 in OTHER".
[[nodiscard]] std::vector<std::string> columns_that_differ(const Outcome& first, const Outcome& second,
                                                           const std::string& one, const std::string& other);

}  // namespace orca::batch
