// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "summary.hpp"

#include <vector>

#include "figures.hpp"
#include "orca/base/text.hpp"

namespace orca::deployer {
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
