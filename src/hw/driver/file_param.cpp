// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/file_param.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/text.hpp"
#include "orca/robots/robot_file.hpp"
#include "orca/xml/number.hpp"

namespace orca::hw {
namespace {

constexpr double kRounding = 1e-4;  // Relative; degrees in a file may exceed a limit in radians by this.

// Reports a fault inside the file with its place there, and a fault of the file as a whole at the parameter.
HardwareFault fault_of(const xml::Diagnostic& diagnostic) {
  const bool whole_file = diagnostic.position.line == 0 || diagnostic.code == "G101";
  if (!whole_file) return {"", diagnostic.text()};
  return {"robot", in_quotes(diagnostic.position.file) + ": " + diagnostic.message};
}

// Returns "at most 1.5 m/s", "at least ..." or "from ... to ...".
std::string range_text(std::optional<double> least, std::optional<double> most, const std::string& unit) {
  const std::string upper = most ? xml::number_text(*most) + " " + unit : "";
  if (!least || *least == 0.0) return "at most " + upper;
  const std::string lower = xml::number_text(*least) + " " + unit;
  return most ? "from " + lower + " to " + upper : "at least " + lower;
}

}  // namespace

RobotFileParam::RobotFileParam(HardwareContainer& owner)
    : path_(owner, "robot", "",
            {.file = true,
             .fixed = true,
             .text = "File of the robot that the device belongs to, as the simulator reads it: URDF with an "
                     "<orca> element. Empty: only the driver's own figures hold."}) {}

std::vector<HardwareFault> RobotFileParam::read() {
  if (!is_named()) return {};
  xml::Diagnostics diagnostics;
  robot_ = robots::read_robot(*path_, diagnostics);
  std::vector<HardwareFault> faults;
  for (const auto& diagnostic : diagnostics.sorted()) faults.push_back(fault_of(diagnostic));
  return faults;
}

std::string RobotFileParam::shown() const { return in_quotes(*path_); }

std::vector<HardwareFault> RobotFileParam::give(FileParam<double>& param, double value,
                                                const std::string& figure, std::optional<double> most) const {
  const ParamOptions& range = param.options();
  if (!most) most = range.max;
  double taken = most ? std::min(value, *most) : value;
  if (range.min) taken = std::max(taken, *range.min);
  param.take_from_file(taken);
  if (param.is_set() || std::abs(taken - value) <= kRounding * std::abs(value)) return {};
  return {{.param = "robot",
           .text = figure + " in " + shown() + " is " + xml::number_text(value) + " " + range.unit +
                   ", but this device can take " + range_text(range.min, most, range.unit) +
                   ", so it counts as " + xml::number_text(taken) + " " + range.unit +
                   "; correct the file, or set " + param.name(),
           .only_warns = true}};
}

}  // namespace orca::hw
