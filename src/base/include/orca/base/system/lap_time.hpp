// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace orca {

/// The time that computing a lap takes: always the same, or drawn from what was measured. A plain value.
struct LapTime {
  std::string file{};  ///< Absolute path of the measurement; empty: the graph says the time itself.
  /// [s] Evenly spaced quantiles, the shortest lap first. One: each lap takes that. None: laps take no time.
  std::vector<double> quantiles{};

  /// Returns the time that so large a share of the laps does not exceed [s], between two quantiles in proportion.
  /// @pre  0 <= share < 1, and there are quantiles.
  [[nodiscard]] double at(double share) const {
    const double place = share * static_cast<double>(quantiles.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const double rest = place - static_cast<double>(below);
    if (rest == 0.0) return quantiles[below];
    return quantiles[below] + rest * (quantiles[below + 1] - quantiles[below]);
  }
  friend bool operator==(const LapTime&, const LapTime&) = default;
};

}  // namespace orca
