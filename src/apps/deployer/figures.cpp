// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "figures.hpp"

#include <cstdio>

namespace orca::deployer {

std::string fixed(double value, int digits) {
  char text[400];  // enough for any double
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string count_of(std::uint64_t number, const std::string& thing) {
  if (number == 0) return "no " + thing + "s";
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

std::string time_text(Duration time, bool simulated, Duration wall) {
  const std::string text = fixed(to_seconds(time), 1) + " s";
  if (!simulated) return text;
  const double factor = wall > Duration{0} ? to_seconds(time) / to_seconds(wall) : 0.0;
  return text + " simulated, " + fixed(factor, factor < 10.0 ? 1 : 0) + " x real time";
}

}  // namespace orca::deployer
