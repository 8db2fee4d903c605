// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cmath>
#include <optional>

#include "algorithm.hpp"
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace {

using orca::avoid::Advice;
using orca::avoid::Echo;
using orca::avoid::EchoMemory;
using Pose = orca::avoid::Motion;

/// Keeps the robot from driving into what its sonars hear (thesis 11.1): has no opinion while the way is
/// free, steers to the nearest free direction and slows down when it is not.
///
/// With odometry it remembers what it heard, and gives advice as often as odometry comes; without, once per
/// round of the sonars and from that round alone.
class SonarAvoid final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Status configure() override {
    lap_on(odometry_.connected() ? "odometry" : "sonar");
    return orca::ok();
  }

  orca::Status start() override {
    memory_.clear();
    heard_at_.reset();
    moved_at_.reset();
    last_direction_ = 0.0;
    return orca::ok();
  }

  orca::Outcome work() override {
    if (odometry_.connected()) {
      follow(*odometry_.get_update());
      if (sonar_.new_data_arrived()) listen(*sonar_.get_update());
    } else {
      memory_.clear();
      listen(*sonar_.get_update_wait());
    }
    advise();
    return orca::again();
  }

  void follow(const orca::idl::Odometry& odometry) {
    const orca::TimePoint stamp = orca::to_time_point(odometry.stamp());
    const Pose pose{odometry.x(), odometry.y(), odometry.steer_angle()};
    if (moved_at_)
      memory_.advance(orca::avoid::between(pose_, pose), orca::to_seconds(stamp - *moved_at_), keep());
    moved_at_ = stamp;
    pose_ = pose;
    speed_ = odometry.translational_velocity();
    turn_rate_ = odometry.steering_velocity();
  }

  // An echo may come from anywhere on the arc of the cone; its middle is taken. What is too near to tell how
  // near may be at the sonar itself. The sonars fire one after the other: meanwhile the robot moves.
  void listen(const orca::idl::SonarRangeReadings& readings) {
    heard_at_ = now();
    for (std::size_t i = 0; i < readings.ranges().size(); ++i) {
      const double heard = readings.ranges()[i];
      if (!(heard < readings.max_range())) continue;
      const double range = heard > readings.min_range() ? heard : 0.0;
      const auto& mount = readings.poses()[i];
      const double yaw = mount.rotation().yaw();
      const Echo echo{mount.position().x() + range * std::cos(yaw),
                      mount.position().y() + range * std::sin(yaw)};
      const double age = i < readings.stamps().size()
                             ? orca::to_seconds(now() - orca::to_time_point(readings.stamps()[i]))
                             : 0.0;
      memory_.hear(seen_after(echo, orca::avoid::arc(speed_, turn_rate_, age)), keep());
    }
  }

  void advise() {
    if (!heard_at_ || orca::to_seconds(now() - *heard_at_) > *deaf_after_) {
      motion_.push(orca::full_stop());
      return;
    }
    const Advice advice = avoid(memory_.echoes(), last_direction_, turn_rate_ * *reaction_time_, limits());
    last_direction_ = advice.direction;
    if (advice.needed) {
      motion_.push(orca::head(advice.direction, advice.speed, *weight_ * insistence(advice.urgency)));
    } else {
      motion_.push(orca::dont_care());
    }
  }

  // 0 where the way is free, 1 half way, 1000 at the stop distance: there no other wish must carry the robot
  // on.
  static double insistence(double urgency) { return urgency / (1.001 - urgency); }

  [[nodiscard]] orca::avoid::EchoMemory::Limits keep() const {
    return {*memory_time_, *echo_time_, *same_place_, *memory_range_};
  }

  [[nodiscard]] orca::avoid::Limits limits() const {
    return {*robot_radius_, *margin_, *side_distance_, *safe_distance_, *stop_distance_, *max_speed_};
  }

  orca::PushProxy<orca::idl::SonarRangeReadings> sonar_{*this, "sonar", {.text = "What the sonars hear."}};
  orca::PushProxy<orca::idl::Odometry> odometry_{
      *this,
      "odometry",
      {.text = "How the robot moves; lets it remember what it heard a moment ago.", .optional = true}};
  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this, "motion", {.text = "A wish per odometry, or per round of the sonars without."}};

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

  orca::Param<double> reaction_time_{
      *this,
      "reaction_time",
      0.25,
      {.unit = "s", .min = 0.0, .text = "From an echo to the robot's following the advice."}};
  orca::Param<double> memory_time_{
      *this,
      "memory_time",
      4.0,
      {.unit = "s", .min = 0.0, .text = "How long an echo counts that was heard twice."}};
  orca::Param<double> echo_time_{
      *this, "echo_time", 0.25, {.unit = "s", .min = 0.0, .text = "How long a single echo counts."}};
  orca::Param<double> same_place_{
      *this,
      "same_place",
      0.15,
      {.unit = "m", .min = 0.0, .text = "Echoes from places nearer than this confirm each other."}};
  orca::Param<double> memory_range_{
      *this,
      "memory_range",
      0.8,
      {.unit = "m", .min = 0.0, .text = "Only echoes from nearer to the robot's centre are kept."}};
  orca::Param<double> deaf_after_{
      *this,
      "deaf_after",
      0.6,
      {.unit = "s", .min = 0.0, .text = "Without a round of the sonars for so long the robot stops."}};

  EchoMemory memory_;
  Pose pose_;
  double speed_ = 0.0;
  double turn_rate_ = 0.0;
  std::optional<orca::TimePoint> moved_at_;
  std::optional<orca::TimePoint> heard_at_;
  double last_direction_ = 0.0;
};

}  // namespace

ORCA_COMPONENT(SonarAvoid, "orca.SonarAvoid")
