// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "laps.hpp"

#include <fstream>
#include <string>

#include "orca/base/system/wall_time.hpp"
#include "orca/graph/laps.hpp"

namespace orca::deployer {
namespace {

constexpr std::size_t kDateLength = 10;  // 2026-11-28

// Returns what the kernel calls the processor, or "unknown".
std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (const auto colon = line.find(": "); line.starts_with("model name") && colon != std::string::npos)
      return line.substr(colon + 2);
  return "unknown";
}

}  // namespace

Status write_laps(OutputFile& file, const graph::Graph& graph, const host::RunResult& result) {
  static_assert(host::LapTimes::kQuantiles == graph::kLapQuantiles);
  graph::LapMeasurement measurement{
      graph.name, processor_name(), log::wall_time_text().substr(0, kDateLength), {}};
  for (const graph::ComponentNode& node : graph.components) {
    const auto times = result.lap_times.find(node.name);
    if (times == result.lap_times.end() || times->second.laps == 0) continue;
    const host::LapTimes& one = times->second;
    measurement.components.push_back(
        {node.name, node.type, one.laps, one.total / static_cast<double>(one.laps), one.quantiles});
  }
  file.write(graph::laps_text(measurement));
  return file.close();
}

}  // namespace orca::deployer
