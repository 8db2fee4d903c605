// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cmath>
#include <deque>
#include <string>

#include "algorithm.hpp"
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace {

using orca::ObjectPtr;
using orca::Status;
using orca::go::Pose;
using orca::go::Step;

/// Drives to a goal in a straight line (thesis 11.1). Via points that come before a goal are passed in order;
/// a goal that comes when the route already ends in one replaces the whole route.
class Goto final : public orca::Component {
 public:
  using Component::Component;

 private:
  Status configure() override {
    if (!localizer_.connected() && !odometry_.connected())
      return orca::fail(orca::Code::failed_precondition,
                        "connect its port localizer or odometry: it must know where it is");
    lap_on(localizer_.connected() ? "localizer" : "odometry");
    return orca::ok();
  }

  Status on_goal(const ObjectPtr<orca::idl::GoalPoint>& goal) {
    const auto& place = goal->coordinate().point();
    if (!std::isfinite(place.x()) || !std::isfinite(place.y()) || !std::isfinite(goal->orientation()))
      return orca::fail(orca::Code::invalid_argument,
                        "the goal \"" + goal->name() + "\" has a coordinate that is not finite");
    if (!route_.empty() && !route_.back()->via()) route_.clear();
    route_.push_back(goal);
    near_ = false;
    return orca::ok();
  }

  orca::Outcome work() override {
    orca::idl::TimeValue stamp;
    const Pose pose = take_pose(stamp);
    pass_via_points(pose);
    if (route_.empty()) {
      motion_.push(orca::dont_care());
      return orca::again();
    }
    near_ = near_ || within_reach(target(), pose);
    const Step step = step_towards(target(), pose, limits(), near_);
    if (step.kind == Step::Kind::reached) {
      arrive(pose, stamp);
    } else {
      motion_.push(orca::head(step.direction, step.speed, *weight_));
    }
    return orca::again();
  }

  void stop() override { near_ = false; }

  Pose take_pose(orca::idl::TimeValue& stamp) {
    if (localizer_.connected()) {
      const auto pose = localizer_.get_update();
      stamp = pose->stamp();
      return {pose->x(), pose->y(), pose->orientation()};
    }
    const auto odometry = odometry_.get_update();
    stamp = odometry->stamp();
    return {odometry->x(), odometry->y(), odometry->steer_angle()};
  }

  void pass_via_points(const Pose& pose) {
    while (!route_.empty() && route_.front()->via() && within_reach(target(), pose)) route_.pop_front();
  }

  void arrive(const Pose& pose, const orca::idl::TimeValue& stamp) {
    auto arrived = arrived_.loan();
    arrived->name() = route_.front()->name();
    arrived->x(pose.x);
    arrived->y(pose.y);
    arrived->stamp(stamp);
    route_.pop_front();
    near_ = false;
    motion_.push(orca::full_stop());
    arrived_.push(std::move(arrived));
  }

  [[nodiscard]] orca::go::Target target() const {
    const orca::idl::GoalPoint& goal = *route_.front();
    const auto& place = goal.coordinate().point();
    return {place.x(),          place.y(),          goal.reach_radius(), goal.use_orientation(),
            goal.orientation(), goal.reach_angle(), goal.via()};
  }

  [[nodiscard]] orca::go::Limits limits() const {
    return {*max_speed_, *slow_down_, *min_speed_, *turn_in_place_};
  }

  orca::SendServer<orca::idl::GoalPoint> goal_{
      *this, "GotoCoordinateSend", &Goto::on_goal, {.text = "Where to go."}};
  orca::PushServer<orca::idl::MotionCommand> motion_{*this, "MotionCmdPush", {.text = "A wish per lap."}};
  orca::PushServer<orca::idl::Arrived> arrived_{*this, "ArrivedPush", {.text = "Once per goal reached."}};
  orca::PushProxy<orca::idl::Odometry> odometry_{
      *this, "odometry", {.text = "Where the robot is, if no localizer is connected.", .optional = true}};
  orca::PushProxy<orca::idl::RobotPose> localizer_{
      *this, "localizer", {.text = "Where the robot is.", .optional = true}};

  orca::Param<double> max_speed_{
      *this, "max_speed", 0.5, {.unit = "m/s", .min = 0.0, .text = "Speed on the way."}};
  orca::Param<double> min_speed_{
      *this, "min_speed", 0.08, {.unit = "m/s", .min = 0.01, .text = "Speed just before the goal."}};
  orca::Param<double> slow_down_{
      *this, "slow_down", 0.8, {.unit = "1/s", .min = 0.0, .text = "Speed per metre left, near the goal."}};
  orca::Param<double> turn_in_place_{
      *this,
      "turn_in_place",
      1.0,
      {.unit = "rad", .min = 0.05, .max = 3.15, .text = "Directions further off are turned to on the spot."}};
  orca::Param<double> weight_{
      *this, "weight", 1.0, {.min = 0.0, .text = "Share of its wishes when they are fused."}};

  std::deque<ObjectPtr<orca::idl::GoalPoint>> route_;
  bool near_ = false;
};

}  // namespace

ORCA_COMPONENT(Goto, "orca.Goto")
