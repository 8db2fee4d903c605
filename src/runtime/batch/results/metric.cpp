// SPDX-License-Identifier: LGPL-3.0-or-later
#include "metric.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace orca::batch {
namespace {

constexpr std::array kBetterWhenMore{"success",        "spl",     "barn_score", "clearance", "clearance_p5",
                                     "clearance_mean", "noticed", "found_again"};
// The metrics of finished runs only: those of an unfinished one cannot be compared with them.
constexpr std::array kOfSuccesses{"time", "way", "way_ratio", "curvature", "jerk", "reversals"};

bool is_among(const auto& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

Metric metric(const char* name, const char* unit, const char* text,
              std::optional<double> Measures::*measure = nullptr, const std::string& needs = "",
              double most = std::numeric_limits<double>::infinity()) {
  const bool of_successes = is_among(kOfSuccesses, name);
  const std::string success = !of_successes ? "" : needs.empty() ? "a success" : "a success and ";
  return {name, unit, text, is_among(kBetterWhenMore, name), of_successes, measure, success + needs, most};
}

std::vector<Metric> listed_metrics() {
  std::vector<Metric> metrics{
      metric("success", "", "Share of the runs that reached all goals and touched nothing."),
      metric("time", "s", "Simulated time until the last goal was reached.")};
  for (const Measure& one : all_measures())
    metrics.push_back(metric(one.name, one.unit, one.text, one.value, one.needs, one.most));
  return metrics;
}

}  // namespace

std::optional<double> Metric::of(const Outcome& outcome) const {
  const bool succeeded = outcome.ending == Ending::success;
  if (is_success()) return succeeded ? 1.0 : 0.0;
  if (of_successes && !succeeded) return std::nullopt;
  return measure == nullptr ? outcome.time : outcome.measures.*measure;
}

const std::vector<Metric>& all_metrics() {
  static const std::vector<Metric> metrics = listed_metrics();
  return metrics;
}

const Metric* find_metric(std::string_view name) {
  const auto found = std::ranges::find(all_metrics(), name, &Metric::name);
  return found == all_metrics().end() ? nullptr : &*found;
}

}  // namespace orca::batch
