// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/robot_file/codes.hpp"
#include "orca/robot_file/devices.hpp"
#include "orca/robot_file/values.hpp"

// The readers of the elements inside <orca>. They add what they read to the devices, and report whatever is wrong at its
// attribute. A new element needs a rule in rules.cpp, a reader, a line in reader.cpp, and, if it sits on a link, a line in
// sim/files/robot/mounts.cpp.
namespace orca::robot_file {

using namespace values;

void read_drive(const xml::Attributes& e, Devices& model);
void read_turret(const xml::Attributes& e, Devices& model);
void read_gripper(const xml::Attributes& e, Devices& model);
void read_battery(const xml::Attributes& e, Devices& model);
void read_sonar_ring(const xml::Attributes& e, Devices& model);
void read_laser(const xml::Attributes& e, Devices& model);
void read_infrared_ring(const xml::Attributes& e, Devices& model);
void read_bumper_ring(const xml::Attributes& e, Devices& model);
void read_camera(const xml::Attributes& e, Devices& model);
void read_odometry(const xml::Attributes& e, Devices& model);

// Reports a name that another device of the robot has, because noise is keyed by it. Returns true if it is
// free.
[[nodiscard]] bool name_is_free(const xml::Attributes& e, const std::string& name, const Devices& model);

// Read the children <wheel_errors> of an odometer, and <range_errors> of a sensor that measures up to `max_range` [m].
[[nodiscard]] Guesses<WheelErrorGuess> read_wheel_errors(const xml::Attributes& odometry);
[[nodiscard]] Guesses<RangeErrorGuess> read_range_errors(const xml::Attributes& sensor, double max_range);

// Reads vendor, model and port.
[[nodiscard]] DeviceLabel read_label(const xml::Attributes& e);

// Reports a range that readings may not have, and a `quantum` [m], if there is one, that leaves nothing of it.
void check_range(const xml::Attributes& e, double min_range, double max_range, double quantum = 0.0);

// Reports a period that is shorter than the simulation's tick, or longer than an hour.
void check_period(const xml::Attributes& e, Duration period);

}  // namespace orca::robot_file
