// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "files/formats/attributes.hpp"
#include "orca/sim/robot_model.hpp"

// The readers of the elements inside <orca>, each in a file of its own. They add what they read to the
// model; whatever is wrong they tell at its attribute. A new element needs a reader, a line in
// robot_extension.cpp, and, if it sits on a link, a line in mounts.cpp.
namespace orca::sim::detail {

void read_drive(const Attributes& e, RobotModel& model);
void read_turret(const Attributes& e, RobotModel& model);
void read_sonar_ring(const Attributes& e, RobotModel& model);
void read_laser(const Attributes& e, RobotModel& model);
void read_infrared_ring(const Attributes& e, RobotModel& model);
void read_bumper_ring(const Attributes& e, RobotModel& model);
void read_odometry(const Attributes& e, RobotModel& model);

// Takes over a value if there is one; the error is told already if not.
template <class To, class From>
void set(To& to, const std::optional<From>& from) {
  if (from) to = *from;
}

// R010 at `name` if another device of the robot has that name: noise is keyed by it.
[[nodiscard]] bool name_is_free(const Attributes& e, const std::string& name, const RobotModel& model);

// R022 at `period`: shorter than the simulation's tick, or longer than an hour.
void check_period(const Attributes& e, Duration period);

}  // namespace orca::sim::detail
