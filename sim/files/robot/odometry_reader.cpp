// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::sim::detail {

void read_odometry(const xml::Attributes& e, RobotModel& model) {
  const auto period = e.duration("period");
  if (!period) return;
  check_period(e, *period);
  model.odometer = Odometer{*period, read_label(e)};
}

}  // namespace orca::sim::detail
