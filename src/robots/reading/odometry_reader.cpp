// SPDX-License-Identifier: LGPL-3.0-or-later
#include "extension_readers.hpp"

namespace orca::robots::detail {

void read_odometry(const xml::Attributes& e, Characteristics& model) {
  const Guesses<WheelErrorGuess> errors = read_wheel_errors(e);
  const auto period = e.duration("period");
  if (!period) return;
  check_period(e, *period);
  model.odometer = Odometer{*period, read_label(e), errors};
}

}  // namespace orca::robots::detail
