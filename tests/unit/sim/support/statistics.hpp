// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace orca::sim::test {

inline double mean(const std::vector<double>& sample) {
  double sum = 0.0;
  for (const double value : sample) sum += value;
  return sum / static_cast<double>(sample.size());
}

/// Returns the unbiased variance.
inline double variance(const std::vector<double>& sample) {
  const double middle = mean(sample);
  double sum = 0.0;
  for (const double value : sample) sum += (value - middle) * (value - middle);
  return sum / static_cast<double>(sample.size() - 1);
}

inline double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

/// Returns Kolmogorov and Smirnov's distance between a sample and a continuous distribution.
template <class Cdf>
double distance_from(std::vector<double> sample, const Cdf& cdf) {
  std::ranges::sort(sample);
  const auto n = static_cast<double>(sample.size());
  double farthest = 0.0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double expected = cdf(sample[i]);
    farthest = std::fmax(farthest, std::fmax(expected - static_cast<double>(i) / n,
                                             static_cast<double>(i + 1) / n - expected));
  }
  return farthest;
}

/// Returns the bound that the distance of a sample of the distribution itself exceeds once in a thousand times
/// (Kolmogorov's limit: 1.949 / sqrt(n)).
inline double critical_distance(std::size_t n) { return 1.949 / std::sqrt(static_cast<double>(n)); }

/// Returns the same bound for the relative error of the variance of a normal sample: 3.29 standard errors.
inline double critical_variance(std::size_t n) { return 3.29 * std::sqrt(2.0 / static_cast<double>(n)); }

}  // namespace orca::sim::test
