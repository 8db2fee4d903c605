// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give a robot or errors.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "orca/sim/robot_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  orca::xml::Diagnostics diagnostics;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto robot = orca::sim::read_robot_text(text, "fuzz.urdf", diagnostics);
  if (robot.has_value() == diagnostics.has_errors()) std::abort();
  if (robot && (!(robot->mass > 0.0) || !std::isfinite(robot->mass + robot->bumper_radius))) std::abort();
  return 0;
}
