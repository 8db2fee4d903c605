// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/robot_figures.hpp"

#include <utility>

namespace orca::hw {

std::vector<double> RobotFigures::bumper_directions() const {
  std::vector<double> all;
  for (const robot_file::BumperRing& ring : bumpers)
    for (std::size_t i = 0; i < ring.count; ++i) all.push_back(ring.segment(i).yaw);
  return all;
}

std::optional<RobotFigures> read_robot_figures(const std::string& path, std::vector<HardwareFault>& faults) {
  if (path.empty()) return std::nullopt;
  xml::Diagnostics diagnostics;
  std::optional<robot_file::Figures> figures = robot_file::read_figures(path, diagnostics);
  for (const xml::Diagnostic& wrong : diagnostics.sorted())
    if (wrong.severity == xml::Severity::error)
      faults.push_back({"robot", wrong.position.text() + ": " + wrong.message});
  if (!figures) return std::nullopt;
  return RobotFigures{std::move(*figures)};
}

}  // namespace orca::hw
