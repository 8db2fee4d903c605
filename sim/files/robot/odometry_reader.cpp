// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"
#include "orca/geometry/usual_figures.hpp"

namespace orca::sim::detail {

void read_odometry(const xml::Attributes& e, RobotModel& model) {
  Guesses<WheelErrorGuess> errors = read_wheel_errors(e);
  if (!errors.is_known()) {
    errors.set(std::nullopt, kUsualWheelErrors);
    errors.set(Realism::harsh, kUsualHarshWheelErrors);
  }
  const auto period = e.duration("period");
  if (!period) return;
  check_period(e, *period);
  model.odometer = Odometer{*period, read_label(e), errors};
}

}  // namespace orca::sim::detail
