// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>

#include "orca/base/time.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// The battery of a robot: it loses charge at an even pace, faster the faster the robot drives, and gains it at a charger. It is full
// at first.
class BatteryModel {
 public:
  explicit BatteryModel(const Battery& battery) : battery_(battery) {}

  // @param effort  share of the greatest speed, 0 to 1.
  void step(double seconds, double effort, bool charging) {
    charging_ = charging;
    const double standing = 1.0 / to_seconds(battery_.standing);
    const double driving = 1.0 / to_seconds(battery_.driving);
    const double gain = charging ? 1.0 / to_seconds(battery_.charging) : 0.0;
    charge_ = std::clamp(charge_ + seconds * (gain - standing - effort * (driving - standing)), 0.0, 1.0);
  }
  void set_charge(double charge) { charge_ = charge; }
  [[nodiscard]] double charge() const { return charge_; }
  [[nodiscard]] bool is_empty() const { return charge_ <= 0.0; }

  // The voltage falls in proportion to the charge, by a sixth in all: so does roughly that of lead cells at rest.
  [[nodiscard]] BatteryReading reading(TimePoint now) const {
    return {now, charge_, battery_.voltage * (1.0 - (1.0 - charge_) / 6.0), charging_};
  }

 private:
  Battery battery_;
  double charge_ = 1.0;
  bool charging_ = false;
};

}  // namespace orca::sim::detail
