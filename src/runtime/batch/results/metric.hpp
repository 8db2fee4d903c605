// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/batch/record.hpp"

namespace orca::batch {

/// A property of a run that variants are compared in: whether it succeeded, its time, or one of the measures.
struct Metric {
  std::string name;
  std::string unit;
  std::string text;
  bool more_is_better = false;
  bool of_successes = false;  ///< Runs without success have it not: their time and way are those of a part.
  std::optional<double> Measures::*measure = nullptr;  ///< Null: success or time.
  std::string needs{};  ///< Needed of a run for it, "a success and a simulated robot"; empty: nothing.
  double most = std::numeric_limits<double>::infinity();  ///< No value is greater, and none below 0.

  [[nodiscard]] bool is_success() const { return name == "success"; }
  /// Returns the value of a run, if it has one.
  [[nodiscard]] std::optional<double> of(const Outcome& outcome) const;
};

/// Returns all metrics, in the order of reports.
[[nodiscard]] const std::vector<Metric>& all_metrics();
/// Returns the metric of that name; null if there is none.
[[nodiscard]] const Metric* find_metric(std::string_view name);

}  // namespace orca::batch
