// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cmath>
#include <vector>

#include "algorithm.hpp"
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"

namespace {

using orca::avoid::Advice;
using orca::avoid::Echo;

/// Keeps the robot from driving into what its sonars hear (thesis 11.1): has no opinion while the way is
/// free, steers to the nearest free direction and slows down when it is not.
class SonarAvoid final : public orca::Component {
 public:
  explicit SonarAvoid(orca::ComponentHost& host) : Component(host) { lap_on("sonar"); }

 private:
  orca::Outcome work() override {
    const auto readings = sonar_.get_update_wait();
    locate_echoes(*readings);
    const Advice advice = orca::avoid::avoid(echoes_, last_direction_, limits());
    last_direction_ = advice.direction;
    if (advice.needed) {
      motion_.push(orca::head(advice.direction, advice.speed, *weight_ * insistence(advice.urgency)));
    } else {
      motion_.push(orca::dont_care());
    }
    return orca::again();
  }

  void stop() override { last_direction_ = 0.0; }

  // 0 where the way is free, 1 half way, 50 at the stop distance: there no other wish must carry the robot
  // on.
  static double insistence(double urgency) { return urgency / (1.02 - urgency); }

  // An echo may come from anywhere on the arc of the cone; its middle is taken.
  void locate_echoes(const orca::idl::SonarRangeReadings& readings) {
    echoes_.clear();
    for (std::size_t i = 0; i < readings.ranges().size(); ++i) {
      const double range = readings.ranges()[i];
      if (!(range < readings.max_range())) continue;
      const auto& mount = readings.poses()[i];
      const double yaw = mount.rotation().yaw();
      echoes_.push_back(
          {mount.position().x() + range * std::cos(yaw), mount.position().y() + range * std::sin(yaw)});
    }
  }

  [[nodiscard]] orca::avoid::Limits limits() const {
    return {*robot_radius_, *margin_, *side_distance_, *safe_distance_, *stop_distance_, *max_speed_};
  }

  orca::PushProxy<orca::idl::SonarRangeReadings> sonar_{*this, "sonar", {.text = "What the sonars hear."}};
  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this, "motion", {.text = "A wish per round of the sonars."}};

  orca::Param<double> robot_radius_{
      *this,
      "robot_radius",
      0.205,
      {.unit = "m", .min = 0.0, .text = "Circle that holds the robot, bumpers too."}};
  orca::Param<double> margin_{
      *this, "margin", 0.1, {.unit = "m", .min = 0.0, .text = "Kept free on both sides."}};
  orca::Param<double> side_distance_{
      *this,
      "side_distance",
      0.2,
      {.unit = "m", .min = 0.0, .text = "Nearer than this the robot turns away from a wall beside it."}};
  orca::Param<double> safe_distance_{
      *this,
      "safe_distance",
      0.8,
      {.unit = "m", .min = 0.1, .text = "A free way this long needs no avoiding."}};
  orca::Param<double> stop_distance_{
      *this,
      "stop_distance",
      0.15,
      {.unit = "m", .min = 0.0, .text = "With a free way this short the robot only turns."}};
  orca::Param<double> max_speed_{
      *this, "max_speed", 0.4, {.unit = "m/s", .min = 0.0, .text = "Speed while avoiding."}};
  orca::Param<double> weight_{
      *this,
      "weight",
      2.0,
      {.min = 0.0, .text = "Share of its wishes when fused, half way to the stop distance."}};

  std::vector<Echo> echoes_;
  double last_direction_ = 0.0;
};

}  // namespace

ORCA_COMPONENT(SonarAvoid, "orca.SonarAvoid")
