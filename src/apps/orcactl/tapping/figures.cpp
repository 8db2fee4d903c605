// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "figures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace orca::orcactl {
namespace {

using supervisor::Cell;
using supervisor::Record;

constexpr double kMillisecond = 1e6;  // [ns]

Cell number(const char* name, const std::vector<double>& values, double value) {
  if (!values.empty()) return {name, value, 3};
  Cell none{name, ""};
  none.kind = Cell::Kind::number;
  return none;
}

double mean_of(const std::vector<double>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return values.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(values.size()));
}

// Returns the value below which a share of the sorted values lies.
double share_of(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return 0.0;
  return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

}  // namespace

void PassedFigures::add(const supervisor::Tapped& passed) {
  const auto difference = [](std::uint64_t later, std::uint64_t earlier) {
    return static_cast<double>(static_cast<std::int64_t>(later - earlier)) / kMillisecond;
  };
  if (last_) gaps_.push_back(difference(passed.passed, *last_));
  last_ = passed.passed;
  ages_.push_back(difference(passed.passed, passed.created));
  lost_ = passed.lost;
}

Record PassedFigures::take_rate(double span) {
  std::ranges::sort(gaps_);
  const std::uint64_t lost = lost_ - std::exchange(lost_before_, lost_);
  const std::size_t count = ages_.size();
  Record record{{"objects", count},
                {"per_second", static_cast<double>(count + lost) / span, 2},
                number("mean_gap_ms", gaps_, mean_of(gaps_)),
                number("least_gap_ms", gaps_, share_of(gaps_, 0.0)),
                number("largest_gap_ms", gaps_, share_of(gaps_, 1.0)),
                number("deviation_ms", gaps_, deviation_of(gaps_)),
                {"left_out", lost}};
  gaps_.clear();
  ages_.clear();
  return record;
}

Record PassedFigures::take_ages() {
  std::ranges::sort(ages_);
  Record record{{"objects", ages_.size()},
                number("mean_ms", ages_, mean_of(ages_)),
                number("median_ms", ages_, share_of(ages_, 0.5)),
                number("p95_ms", ages_, share_of(ages_, 0.95)),
                number("largest_ms", ages_, share_of(ages_, 1.0)),
                {"left_out", lost_ - std::exchange(lost_before_, lost_)}};
  gaps_.clear();
  ages_.clear();
  return record;
}

}  // namespace orca::orcactl
