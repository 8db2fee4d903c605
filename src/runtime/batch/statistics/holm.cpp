// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/holm.hpp"

#include <algorithm>
#include <numeric>
#include <string>

namespace orca::batch {

Result<std::vector<double>> holm(std::span<const double> p_values) {
  for (std::size_t i = 0; i < p_values.size(); ++i)
    if (!(p_values[i] >= 0.0 && p_values[i] <= 1.0))
      return fail(Code::invalid_argument, "p-value " + std::to_string(i + 1) + " of " +
                                              std::to_string(p_values.size()) +
                                              " is not a number from 0 to 1");
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return p_values[i]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0.0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto factor = static_cast<double>(order.size() - rank);
    largest = std::max(largest, std::min(1.0, factor * p_values[order[rank]]));
    adjusted[order[rank]] = largest;
  }
  return adjusted;
}

}  // namespace orca::batch
