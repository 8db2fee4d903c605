// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "orca/base/system/lap_time.hpp"

namespace orca::graph {

/// Number of quantiles in a measurement, 5 % apart.
inline constexpr std::size_t kLapQuantiles = 21;

/// The laps of one component, as a machine computed them. A plain value.
struct MeasuredLaps {
  std::string component;  ///< As the graph names it.
  std::string type;
  std::uint64_t laps = 0;         ///< Number that were measured.
  double mean = 0.0;              ///< [s] Processor time of a lap.
  std::vector<double> quantiles;  ///< [s] As those of LapTime.
};

/// A measurement of the laps of a graph's components. A plain value.
struct LapMeasurement {
  std::string graph;      ///< Its name.
  std::string processor;  ///< The machine's, for people.
  std::string date;       ///< In UTC, for people.
  std::vector<MeasuredLaps> components;
};

/// Writes a measurement as the file that `takes` names.
[[nodiscard]] std::string laps_text(const LapMeasurement& measurement);

}  // namespace orca::graph
