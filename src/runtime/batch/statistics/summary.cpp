// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/summary.hpp"

#include <algorithm>

#include "input_checks.hpp"
#include "moments.hpp"

namespace orca::batch {
namespace {

Result<std::vector<double>> sorted_values(std::span<const double> values) {
  if (const Status status = check_values(values); !status) return status.error();
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  return sorted;
}

// Returns the share of the pairs of runs in which the first value is larger; equal ones count half.
double share_of_improvements(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<double> sorted = second;
  std::ranges::sort(sorted);
  double larger = 0.0;
  for (const double value : first) {
    const auto equal = std::ranges::equal_range(sorted, value);
    larger += static_cast<double>(equal.begin() - sorted.begin()) + 0.5 * static_cast<double>(equal.size());
  }
  return larger / (static_cast<double>(first.size()) * static_cast<double>(second.size()));
}

}  // namespace

// Sums what the values differ from the first one, so that the mean of equal values is exact.
double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value - values.front();
  return values.front() + sum / static_cast<double>(values.size());
}

double quantile_of_sorted(std::span<const double> sorted, double q) {
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto index = std::min(static_cast<std::size_t>(position), sorted.size() - 1);
  const double low = sorted[index];
  const double high = sorted[std::min(index + 1, sorted.size() - 1)];
  const double part = position - static_cast<double>(index);
  return part < 0.5 ? low + (high - low) * part : high - (high - low) * (1.0 - part);
}

Result<double> mean(std::span<const double> values) {
  if (const Status status = check_values(values); !status) return status.error();
  return mean_of(values);
}

Result<double> quantile(std::span<const double> values, double q) {
  if (!(q >= 0.0 && q <= 1.0)) return fail(Code::invalid_argument, "a quantile needs a share from 0 to 1");
  return sorted_values(values).and_then(
      [q](const std::vector<double>& sorted) -> Result<double> { return quantile_of_sorted(sorted, q); });
}

Result<double> median(std::span<const double> values) { return quantile(values, 0.5); }

Result<double> interquartile_mean(std::span<const double> values) {
  return sorted_values(values).and_then([](const std::vector<double>& sorted) -> Result<double> {
    const std::size_t cut = sorted.size() / 4;
    return mean_of(std::span(sorted).subspan(cut, sorted.size() - 2 * cut));
  });
}

Result<std::vector<double>> world_means(ValuesByWorld worlds) {
  if (const Status status = check_worlds(worlds); !status) return status.error();
  std::vector<double> means;
  for (const std::vector<double>& values : worlds) means.push_back(mean_of(values));
  return means;
}

Result<std::vector<std::vector<double>>> paired_differences(ValuesByWorld first, ValuesByWorld second) {
  if (const Status status = check_same_worlds(first, second); !status) return status.error();
  std::vector<std::vector<double>> differences;
  for (std::size_t i = 0; i < first.size(); ++i) {
    Result<std::vector<double>> of_world = differences_of(first[i], second[i]);
    if (!of_world)
      return fail(of_world.error().code, of_world.error().message, "world " + std::to_string(i + 1));
    differences.push_back(*std::move(of_world));
  }
  if (const Status status = check_worlds(differences); !status) return status.error();
  return differences;
}

Result<double> probability_of_improvement(ValuesByWorld first, ValuesByWorld second) {
  if (const Status status = check_same_worlds(first, second); !status) return status.error();
  std::vector<double> shares;
  for (std::size_t i = 0; i < first.size(); ++i) shares.push_back(share_of_improvements(first[i], second[i]));
  return mean_of(shares);
}

}  // namespace orca::batch
