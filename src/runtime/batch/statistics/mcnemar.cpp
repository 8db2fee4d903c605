// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/statistics/mcnemar.hpp"

#include <algorithm>

namespace orca::batch {
namespace {

// Returns twice the probability that a fair coin shows heads at most `fewer` times when it is thrown `throws` times, for
// 2 fewer <= throws; at most 1. The weights are the binomial coefficients over the middle one, so none overflows.
double two_sided_coin_tail(std::uint64_t fewer, std::uint64_t throws) {
  double weight = 1.0;
  double tail = 0.0;
  double lower_half = 0.0;
  for (std::uint64_t heads = throws / 2; weight > 0.0; --heads) {
    lower_half += weight;
    if (heads <= fewer) tail += weight;
    weight *= static_cast<double>(heads) / static_cast<double>(throws - heads + 1);  // 0 after heads = 0
  }
  const double all = 2.0 * lower_half - (throws % 2 == 0 ? 1.0 : 0.0);  // the middle counts once
  return std::min(1.0, 2.0 * tail / all);
}

}  // namespace

McNemar mcnemar(std::uint64_t only_first, std::uint64_t only_second) {
  return {only_first, only_second,
          two_sided_coin_tail(std::min(only_first, only_second), only_first + only_second)};
}

Result<McNemar> mcnemar(std::span<const SuccessPair> pairs) {
  if (pairs.empty()) return fail(Code::invalid_argument, "there are no pairs; at least one is needed");
  std::uint64_t only_first = 0;
  std::uint64_t only_second = 0;
  for (const SuccessPair& pair : pairs) {
    only_first += pair.first && !pair.second ? 1 : 0;
    only_second += pair.second && !pair.first ? 1 : 0;
  }
  return mcnemar(only_first, only_second);
}

}  // namespace orca::batch
