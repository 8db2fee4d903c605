// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::robots::detail {

void read_turret(const xml::Attributes& e, Characteristics& model) {
  Turret turret;
  set(turret.joint, e.text("joint"));
  set(turret.max_speed, e.number("max_speed"));
  set(turret.max_acceleration, e.number("max_acceleration"));
  set(turret.period, e.duration("period"));
  if (turret.period > Duration{0}) check_period(e, turret.period);
  turret.label = read_label(e);
  model.turret = turret;
}

}  // namespace orca::robots::detail
