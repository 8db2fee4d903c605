// SPDX-License-Identifier: GPL-3.0-or-later
// The behaviour of docs/first_comparison.md.
// [behaviour]
#include <algorithm>

#include "orca/component.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"

namespace {

/// Where something is near, turns towards the beam that finds the most room.
class MostRoom final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::PushProxy<orca::idl::LaserRangeReadings> laser_{*this, "laser"};
  orca::PushProxy<orca::idl::Odometry> odometry_{*this, "odometry"};
  orca::PushProxy<orca::idl::GoalPoint> goal_{*this, "goal"};
  orca::PushProxy<orca::idl::RobotPose> localizer_{*this, "localizer"};
  orca::QueryProxy<orca::idl::Ask, orca::idl::Robot> robot_{*this, "robot"};
  orca::PushServer<orca::idl::MotionCommand> motion_{*this, "motion"};
  orca::Param<double> margin_{*this, "margin", 0.1, {.unit = "m", .min = 0.0}};

  orca::Outcome work() override {
    const auto scan = laser_.get_update_wait();
    const auto ranges = scan->ranges();
    if (std::ranges::min(ranges) > 0.3 + *margin_) {
      motion_.push(orca::dont_care());
    } else {
      const auto beam = static_cast<double>(std::ranges::max_element(ranges) - ranges.begin());
      motion_.push(orca::head(scan->angle_start() + beam * scan->angle_increment(), 0.1, 100.0));
    }
    return orca::again();
  }
};

}  // namespace

ORCA_COMPONENT(MostRoom, "my.MostRoom")
// [/behaviour]
