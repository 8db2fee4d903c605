// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>

#include "orca/batch/store.hpp"

namespace orca::batch {

/// The processor time that laps took, over all runs of a variant. It differs each time that a batch is made. A plain value.
struct LapTimes {
  struct Sum {
    std::uint64_t laps = 0;
    double time = 0.0;     ///< [s] of all laps.
    double longest = 0.0;  ///< [s] of one lap.
    [[nodiscard]] double mean() const { return laps == 0 ? 0.0 : time / static_cast<double>(laps); }
  };
  std::map<std::string, std::map<std::string, Sum>> of_variant;  ///< By variant and component.

  void add(const Row& row) {
    for (const LapCost& one : row.cost.laps) {
      Sum& sum = of_variant[row.variant][one.component];
      sum.laps += one.laps;
      sum.time += one.mean * static_cast<double>(one.laps);
      sum.longest = std::max(sum.longest, one.longest);
    }
  }
};

}  // namespace orca::batch
