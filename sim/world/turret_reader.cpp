// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::sim::detail {

void read_turret(const Attributes& e, RobotModel& model) {
  e.allow({"joint", "max_speed", "max_acceleration"}, {});
  Turret turret;
  set(turret.joint, e.text("joint"));
  set(turret.max_speed, e.quantity("max_speed", "rad/s", Sign::positive));
  set(turret.max_acceleration, e.quantity("max_acceleration", "rad/s2", Sign::positive));
  model.turret = turret;
}

}  // namespace orca::sim::detail
