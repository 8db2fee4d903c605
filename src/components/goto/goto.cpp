// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cmath>
#include <deque>
#include <optional>
#include <string>

#include "algorithm.hpp"
#include "orca/component.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace {

using orca::ObjectPtr;
using orca::Pose2;
using orca::Status;
using orca::go::Step;

/// A behaviour that drives to a goal in a straight line (thesis 11.1). It circles around a goal whose
/// reach_radius is 0 until another goal comes. A goal may lie above or below the robot: its reach is a ball.
/// Via points that come before a goal are passed in order. A goal that comes when the route already ends in a
/// goal replaces the whole route.
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
    if (const char* fault = fault_of(*goal); fault != nullptr)
      return orca::fail(orca::Code::invalid_argument, "the goal \"" + goal->name() + "\" " + fault);
    if (!route_.empty() && !route_.back()->via()) route_.clear();
    route_.push_back(goal);
    before_.near = false;
    return orca::ok();
  }

  // Returns why the robot cannot go there; null if it can.
  [[nodiscard]] const char* fault_of(const orca::idl::GoalPoint& goal) const {
    const auto& place = goal.coordinate().point();
    for (const double number :
         {place.x(), place.y(), place.z(), goal.orientation(), goal.reach_radius(), goal.reach_angle()})
      if (!std::isfinite(number)) return "holds a number that is not finite";
    if (goal.reach_radius() < 0.0) return "has a negative reach_radius";
    if (goal.use_orientation() && goal.reach_angle() <= 0.0)
      return "has an orientation to take with a reach_angle that is not positive";
    if (goal.reach_radius() > 0.0 && std::abs(place.z() - *height_) >= goal.reach_radius())
      return "lies so far above or below the robot that no place on the floor is within its reach_radius";
    return nullptr;
  }

  orca::Outcome work() override {
    const Pose2 pose = take_pose();
    pass_via_points(pose);
    if (route_.empty()) {
      before_ = {};
      motion_.push(orca::dont_care());
      return orca::again();
    }
    goal_push_.push(*route_.front());
    before_.near = before_.near || within_reach(target(), pose);
    const Step step = step_towards(target(), pose, limits(), before_);
    before_.speed = step.speed;
    if (step.kind == Step::Kind::reached) {
      arrive(pose);
    } else {
      motion_.push(orca::head(step.direction, step.speed, *weight_));
    }
    return orca::again();
  }

  void stop() override {
    before_ = {};
    posed_at_.reset();
  }

  Pose2 take_pose() {
    if (!localizer_.connected()) {
      const auto odometry = odometry_.get_update();
      note_time(odometry->stamp());
      return orca::plane_pose(*odometry);
    }
    const auto pose = localizer_.get_update();
    note_time(pose->stamp());
    return orca::plane_pose(*pose);
  }

  void note_time(const orca::idl::TimeValue& stamp) {
    const orca::TimePoint time = orca::to_time_point(stamp);
    before_.time = posed_at_ ? orca::to_seconds(time - *posed_at_) : 0.0;
    posed_at_ = time;
  }

  void pass_via_points(const Pose2& pose) {
    while (!route_.empty() && route_.front()->via() && within_reach(target(), pose)) route_.pop_front();
  }

  void arrive(const Pose2& pose) {
    auto arrived = arrived_.loan();
    arrived->name() = route_.front()->name();
    arrived->x(pose.x);
    arrived->y(pose.y);
    arrived->stamp(orca::to_time_value(*posed_at_));
    route_.pop_front();
    before_ = {};
    motion_.push(orca::full_stop());
    arrived_.push(std::move(arrived));
  }

  [[nodiscard]] orca::go::Target target() const {
    const orca::idl::GoalPoint& goal = *route_.front();
    const auto& place = goal.coordinate().point();
    return {{place.x(), place.y()}, place.z() - *height_, goal.reach_radius(), goal.use_orientation(),
            goal.orientation(),     goal.reach_angle(),   goal.via()};
  }

  [[nodiscard]] orca::go::Limits limits() const {
    return {*max_speed_, *slow_down_, *min_speed_, *turn_in_place_, *deceleration_, *circle_radius_};
  }

  orca::SendServer<orca::idl::GoalPoint> goal_{
      *this, "GotoCoordinateSend", &Goto::on_goal, {.text = "Via points and goals to drive to."}};
  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this,
      "MotionCmdPush",
      {.text = "One command per lap: a wish, full stop on arrival, no opinion without a goal."}};
  orca::PushServer<orca::idl::Arrived> arrived_{
      *this, "ArrivedPush", {.text = "One object per goal reached; none for via points."}};
  orca::PushServer<orca::idl::GoalPoint> goal_push_{
      *this, "GoalPush", {.text = "The via point or goal that it drives to now, once per lap."}};
  orca::PushProxy<orca::idl::Odometry> odometry_{
      *this, "odometry", {.text = "Pose of the robot, used if no localizer is connected.", .optional = true}};
  orca::PushProxy<orca::idl::RobotPose> localizer_{
      *this, "localizer", {.text = "Pose of the robot, in the frame of the goals.", .optional = true}};

  orca::Param<double> max_speed_{
      *this, "max_speed", 0.5, {.unit = "m/s", .min = 0.0, .text = "Largest speed on the way."}};
  orca::Param<double> min_speed_{
      *this,
      "min_speed",
      0.08,
      {.unit = "m/s", .min = 0.01, .text = "Smallest speed of the approach to a goal."}};
  orca::Param<double> slow_down_{
      *this,
      "slow_down",
      0.8,
      {.unit = "1/s",
       .min = 0.0,
       .text = "Near a goal the speed is this times the distance left, at least min_speed."}};
  orca::Param<double> turn_in_place_{
      *this,
      "turn_in_place",
      1.0,
      {.unit = "rad",
       .min = 0.05,
       .max = 3.15,
       .text = "Angle to the target beyond which the robot turns on the spot first."}};
  orca::Param<double> deceleration_{
      *this,
      "deceleration",
      0.5,
      {.unit = "m/s2", .min = 0.01, .text = "Deceleration to rest within reach of a goal."}};
  orca::Param<double> circle_radius_{
      *this,
      "circle_radius",
      0.6,
      {.unit = "m", .min = 0.05, .text = "Radius of the circle around a goal whose reach_radius is 0."}};
  orca::Param<double> height_{
      *this, "height", 0.0, {.unit = "m", .text = "Height (z) of the robot in the frame of the goals."}};
  orca::Param<double> weight_{
      *this,
      "weight",
      1.0,
      {.min = 0.0, .text = "Weight of its wishes, relative to other behaviours; 0: they never count."}};

  std::deque<ObjectPtr<orca::idl::GoalPoint>> route_;
  orca::go::Before before_;
  std::optional<orca::TimePoint> posed_at_;
};

}  // namespace

ORCA_COMPONENT(Goto, "orca.Goto")
