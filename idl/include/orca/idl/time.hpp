// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/time.hpp"
#include "orca/idl/generated/time.h"

namespace orca {

/// Converts the time value of an object to an instant.
[[nodiscard]] inline TimePoint to_time_point(const idl::TimeValue& value) {
  return TimePoint(Duration(value.ns()));
}

[[nodiscard]] inline idl::TimeValue to_time_value(TimePoint instant) {
  idl::TimeValue value;
  value.ns(instant.time_since_epoch().count());
  return value;
}

}  // namespace orca
