// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/base/time.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/sim/readings.hpp"

namespace orca::sim {

/// Sees that wheels do not turn although they should, as the controllers of real bases do.
///
/// Thread contract: one strand.
class StallWatch {
 public:
  /// Takes a reading of the wheels.
  /// @return whether they have not turned for half a second, in which they should have; then that time begins anew.
  [[nodiscard]] bool look(const OdometryReading& reading);
  /// Returns whether the wheels turn too slowly by this reading.
  [[nodiscard]] bool is_slow(const OdometryReading& reading) const;
  /// Notes what the motors were told last.
  void driven(const Twist2& velocity, TimePoint now);

 private:
  Twist2 driven_;
  std::optional<TimePoint> turned_at_;  // last time at which the wheels stood as they should, or turned
};

}  // namespace orca::sim
