// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/hw/scene.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/sim/world.hpp"
#include "shared_world.hpp"

namespace orca::sim {

/// Fills the framework's objects with what the simulator measured.
void fill(idl::SonarRangeReadings& object, const SonarScan& scan, const SonarRing& ring);
void fill(idl::Odometry& object, const OdometryReading& reading);
void fill(idl::RobotPose& object, const SharedWorld::Inbox::Truth& truth);

/// The robot's description for whoever asks.
[[nodiscard]] idl::Robot describe(const RobotModel& model, const std::string& name);

/// Adds the walls, if no other robot of the same world has done so, and the robot of that name.
void draw(const Scene& from, const std::string& robot, double radius, orca::Scene& to);

}  // namespace orca::sim
