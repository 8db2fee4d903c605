// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// Half an avoid behaviour: turns away from echoes of the sonars on its side, the one straight ahead
/// included.
class SideAvoid final : public orca::Component {
 public:
  explicit SideAvoid(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(50));
  }

 private:
  orca::Outcome work() override {
    const double nearest = nearest_on(*sonar_.get_update(), *side_ == "left" ? 1.0 : -1.0);
    if (nearest >= kFar) {
      motion_.push(orca::dont_care());
    } else {
      motion_.push(orca::head(*side_ == "left" ? -kAway : kAway, 0.15, 4.0 * (kFar - nearest) / kFar));
    }
    return orca::again();
  }

  static double nearest_on(const orca::idl::SonarRangeReadings& round, double side) {
    double nearest = kFar;
    for (std::size_t i = 0; i < round.ranges().size(); ++i) {
      const double bearing = side * std::remainder(round.poses()[i].rotation().yaw(), 2.0 * M_PI);
      if (bearing > -0.01 && bearing < 1.4) nearest = std::min(nearest, round.ranges()[i]);
    }
    return nearest;
  }

  static constexpr double kFar = 0.9;   // [m]
  static constexpr double kAway = 0.8;  // [rad]

  orca::PushProxy<orca::idl::SonarRangeReadings> sonar_{*this, "sonar"};
  orca::PushServer<orca::idl::MotionCommand> motion_{*this, "motion"};
  orca::Param<std::string> side_{*this, "side", "left", {.choices = {"left", "right"}}};
};

}  // namespace

ORCA_COMPONENT(SideAvoid, "test.SideAvoid")
