// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::sim::detail {

void read_gripper(const xml::Attributes& e, RobotModel& model) {
  Gripper gripper;
  set(gripper.link, e.text("link"));
  set(gripper.opening, e.number("opening"));
  set(gripper.depth, e.number("depth"));
  set(gripper.lift, e.number("lift"));
  set(gripper.paddle_time, e.duration("paddle_time"));
  set(gripper.lift_time, e.duration("lift_time"));
  set(gripper.period, e.duration("period"));
  if (gripper.period > Duration{0}) check_period(e, gripper.period);
  gripper.label = read_label(e);
  model.gripper = gripper;
}

}  // namespace orca::sim::detail
