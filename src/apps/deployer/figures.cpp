// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "figures.hpp"

#include <cstdio>
#include <vector>

#include "orca/base/text.hpp"

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

namespace {

std::string way_text(const host::RunResult::Way& way, double seconds) {
  std::string text = way.robot + " has driven " + fixed(way.length, 1) + " m";
  if (seconds > 0.0) text += " at " + fixed(way.length / seconds, 2) + " m/s on average";
  return text;
}

}  // namespace

std::string summary_text(const host::RunResult& result, Duration wall) {
  const Duration time = result.end - result.start;
  std::vector<std::string> parts{time_text(time, result.trace_hash.has_value(), wall),
                                 count_of(result.arrivals.size(), "arrival"),
                                 count_of(result.contacts.size(), "contact")};
  for (const host::RunResult::Way& way : result.ways) parts.push_back(way_text(way, to_seconds(time)));
  return printable(listed(parts)) + "\n";
}

}  // namespace orca::deployer
