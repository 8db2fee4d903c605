// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::sim::detail {

void read_turret(const Attributes& e, RobotModel& model) {
  e.allow({"joint", "max_speed", "max_acceleration", "period"}, {});
  Turret turret;
  set(turret.joint, e.text("joint"));
  set(turret.max_speed, e.quantity("max_speed", "rad/s", Sign::positive));
  set(turret.max_acceleration, e.quantity("max_acceleration", "rad/s2", Sign::positive));
  set(turret.period, e.duration("period", Sign::positive));
  if (turret.period > Duration{0}) check_period(e, turret.period);
  model.turret = turret;
}

}  // namespace orca::sim::detail
