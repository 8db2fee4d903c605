// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"

namespace orca::ros {

/// A ring of sensors whose readings come as one message each (sensor_msgs/msg/Range), told apart by their frames.
///
/// Thread contract: not synchronised.
class RangeRing {
 public:
  /// Takes a reading, and returns all sensors' latest ones as one ring, in the order of their frames. Sensors that have been silent for
  /// two seconds are left out.
  /// @param reading  a ring of one: SonarRangeReadings or InfraredRangeReadings. Other objects come back as they are.
  [[nodiscard]] ObjectRef take(const ObjectRef& reading);

 private:
  std::map<std::string, ObjectRef> latest_;  // by frame
};

}  // namespace orca::ros
