// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/wilcoxon.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "input_checks.hpp"
#include "normal.hpp"

namespace orca::batch {
namespace {

constexpr std::size_t kMostExactPairs = 25;

// Differences by their size, zeros left out.
std::vector<double> sorted_by_size(std::span<const double> differences) {
  std::vector<double> sorted;
  std::ranges::copy_if(differences, std::back_inserter(sorted), [](double d) { return d != 0.0; });
  std::ranges::sort(sorted, {}, [](double d) { return std::fabs(d); });
  return sorted;
}

// Adds the ranks of both signs. Returns the sum of t^3 - t over groups of t equal sizes.
double add_ranks(const std::vector<double>& sorted, Wilcoxon& result) {
  double ties = 0.0;
  for (std::size_t begin = 0; begin < sorted.size();) {
    std::size_t end = begin + 1;
    while (end < sorted.size() && std::fabs(sorted[end]) == std::fabs(sorted[begin])) ++end;
    const double rank = 0.5 * static_cast<double>(begin + 1 + end);
    for (std::size_t i = begin; i < end; ++i)
      (sorted[i] > 0.0 ? result.positive_ranks : result.negative_ranks) += rank;
    const auto count = static_cast<double>(end - begin);
    ties += (count * count - 1.0) * count;
    begin = end;
  }
  return ties;
}

// Returns twice the share of the subsets of the ranks 1 ... pairs whose sum is at most `smaller`.
double exact_p(std::size_t pairs, std::size_t smaller) {
  const std::size_t largest = pairs * (pairs + 1) / 2;
  std::vector<double> subsets(largest + 1, 0.0);  // by their sum; whole numbers up to 2^25
  subsets[0] = 1.0;
  for (std::size_t rank = 1; rank <= pairs; ++rank)
    for (std::size_t sum = largest; sum >= rank; --sum) subsets[sum] += subsets[sum - rank];
  double count = 0.0;
  for (std::size_t sum = 0; sum <= smaller; ++sum) count += subsets[sum];
  return std::min(1.0, std::ldexp(count, 1 - static_cast<int>(pairs)));
}

double approximate_p(std::size_t pairs, double smaller, double ties) {
  const auto n = static_cast<double>(pairs);
  const double expected = n * (n + 1.0) / 4.0;
  const double variance = (n * (n + 1.0) * (2.0 * n + 1.0) - 0.5 * ties) / 24.0;
  return two_sided_normal_tail((smaller - expected) / std::sqrt(variance));
}

}  // namespace

Result<Wilcoxon> wilcoxon(std::span<const double> differences) {
  if (const Status status = check_values(differences); !status) return status.error();
  const std::vector<double> sorted = sorted_by_size(differences);
  Wilcoxon result{.used = sorted.size()};
  if (sorted.empty()) return result;
  const double ties = add_ranks(sorted, result);
  const double smaller = std::min(result.positive_ranks, result.negative_ranks);
  result.exact = ties == 0.0 && differences.size() == sorted.size() && sorted.size() <= kMostExactPairs;
  result.p = result.exact ? exact_p(sorted.size(), static_cast<std::size_t>(smaller))
                          : approximate_p(sorted.size(), smaller, ties);
  return result;
}

Result<Wilcoxon> wilcoxon(std::span<const double> first, std::span<const double> second) {
  const Result<std::vector<double>> differences = differences_of(first, second);
  if (!differences) return differences.error();
  return wilcoxon(*differences);
}

}  // namespace orca::batch
