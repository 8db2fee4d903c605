// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/component.hpp"

namespace orca::gate {

constexpr const char* kNoneAhead = "none of its sensors looks ahead; are they where the robot's file says?";

// One of the lasers or sonar rings that the gate hears.
template <class Reading>
struct Sensor {
  typename PushProxyArray<Reading>::Source source;
  std::optional<TimePoint> heard{};  // When its last valid reading came.
  std::vector<TimePoint> fired{};    // By sonar: the stamp of its last reading.
  ObjectPtr<Reading> waiting{};      // A scan that is newer than the odometry.
  bool ahead = false;                // Whether its last valid reading looks ahead.
};

}  // namespace orca::gate
