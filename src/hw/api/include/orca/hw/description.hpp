// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/object.hpp"

namespace orca::hw {

/// Returns the part of a robot's description that a client asks for by Query: the body, and of the devices
///
/// * all, if `about` is empty;
/// * those that move it, with their limits, if it is "limits";
/// * the one of that name: a drive, another actuator or a sensor;
/// * the sensors that deliver that object type, for example "LaserRangeReadings".
///
/// @errors  not_found, naming what the robot has, if nothing is called so.
/// @thread  pure function; any thread.
[[nodiscard]] Result<Loan<idl::Robot>> part_of(const idl::Robot& robot, const std::string& about);

/// Where the code of a driver comes from, and what it is connected to.
struct DriverOrigin {
  std::string library;  ///< File name of the plugin.
  std::string driver;   ///< Hardware type.
  std::string line;     ///< The connection, as the graph names it; empty: the device has none.
};

/// Fills in what a driver has left empty in the description of its devices: library, driver and port, and vendor and model, which
/// are those of the robot.
/// @thread  pure function; any thread.
void complete(idl::Robot& robot, const DriverOrigin& origin);

/// Returns what robot files and messages call a kind of drive: "differential".
/// @thread  pure function; any thread.
[[nodiscard]] const char* name_of(idl::DriveType type);

}  // namespace orca::hw
