// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/hw/actuator.hpp"
#include "orca/hw/endpoints.hpp"

namespace orca::hw {

/// The endpoints of one hardware container. They belong to its driver.
///
/// Thread contract: declared before others use it, and not changed after that.
class EndpointList {
 public:
  [[nodiscard]] const std::vector<SensorEndpoint*>& sensors() const { return sensors_; }
  /// Returns the motion of its base; null if it has none.
  [[nodiscard]] MotionHW* motion() const { return motion_; }
  /// Returns what else moves.
  [[nodiscard]] const std::vector<ActuatorEndpoint*>& actuators() const { return actuators_; }

 protected:
  ~EndpointList() = default;

  /// @pre  called from prepare(); the endpoints live as long as the container.
  void add_sensor(SensorEndpoint& sensor) { sensors_.push_back(&sensor); }
  void set_motion(MotionHW& motion) { motion_ = &motion; }
  void add_actuator(ActuatorEndpoint& actuator) { actuators_.push_back(&actuator); }

 private:
  std::vector<SensorEndpoint*> sensors_;
  MotionHW* motion_ = nullptr;
  std::vector<ActuatorEndpoint*> actuators_;
};

}  // namespace orca::hw
