// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include "orca/sim/robot_file.hpp"
#include "orca/sim/world_file.hpp"

namespace orca::sim::test {

inline const std::string kRobots = ORCA_SOURCE_DIR "/sim/robots/";

/// Returns the shipped robot of that name; its file must be without fault.
inline RobotModel shipped(const std::string& name) {
  xml::Diagnostics diagnostics;
  auto model = read_robot(kRobots + name + ".urdf", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(model);
  REQUIRE(diagnostics.text().empty());
  return *model;
}

/// Returns the shipped world of that name; its file must be without fault.
inline WorldModel shipped_world(const std::string& name) {
  xml::Diagnostics diagnostics;
  auto world = read_world(ORCA_SOURCE_DIR "/sim/worlds/" + name + ".xml", {}, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(world);
  REQUIRE(diagnostics.text().empty());
  return *world;
}

}  // namespace orca::sim::test
