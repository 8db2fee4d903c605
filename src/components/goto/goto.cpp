// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "algorithm.hpp"
#include "fault.hpp"
#include "legs.hpp"
#include "orca/component.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "path.hpp"
#include "patience.hpp"
#include "route.hpp"

namespace {

using orca::ObjectPtr;
using orca::Pose2;
using orca::Status;
using orca::go::Step;

/// A behaviour that drives to a goal in a straight line (thesis 11.1). It circles around a goal whose
/// reach_radius is 0 until another goal comes. A goal may lie above or below the robot: its reach is a ball.
/// Via points that come before a goal are passed in order. A point that comes when the route already ends in
/// a goal, or belongs to another mission, replaces the whole route. It drives through doors in a straight line.
/// While somebody subscribes to its failures it gives up goals that it cannot reach. It has not arrived as long as it
/// does not know well enough where it is.
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

  Status start() override {
    motion_.start(lap_period());
    return orca::ok();
  }

  // The legs of a door are laid out anew from where the robot is.
  void save_state(orca::StateWriter& state) const override {
    state.write(route_, patience_, before_, posed_at_, doubts_);
  }
  Status load_state(orca::StateReader& state) override {
    return state.read(route_, patience_, before_, posed_at_, doubts_);
  }

  Status on_goal(const ObjectPtr<orca::idl::GoalPoint>& goal) {
    if (route_.is_given_up(*goal))
      return orca::fail(orca::Code::failed_precondition,
                        "the route to \"" + goal->name() + "\" has been given up");
    const char* fault = orca::go::fault_of(*goal, *height_);
    if (const auto door = goal.as<orca::idl::Door>(); door && fault == nullptr)
      fault = orca::go::fault_of_door(*door, *door_room_);
    if (fault != nullptr) return refuse(*goal, fault);
    route_.add(goal, now());
    doubts_ = false;
    before_.near = false;
    patience_.begin();
    return orca::ok();
  }

  Status refuse(const orca::idl::GoalPoint& goal, const char* fault) {
    if (goal.mission() != 0) route_.give_up(goal.mission());
    if (failed_.subscriber_count() > 0)
      announce(goal, orca::idl::GOAL_REFUSED, std::string("refused: it ") + fault);
    return orca::fail(orca::Code::invalid_argument, "the goal \"" + goal.name() + "\" " + fault);
  }

  orca::Outcome work() override {
    const Pose2 pose = take_pose();
    pass_via_points(pose);
    if (route_.empty()) {
      before_ = {};
      motion_.push(orca::dont_care());
    } else if (!is_hopeless(pose)) {
      drive(pose);
    }
    push_path(pose);
    return orca::again();
  }

  // Shows the way that is left, if it has changed or somebody has come who has not seen it.
  void push_path(const Pose2& pose) {
    const PathShown now_shown{route_.changes(), path_.subscriber_count()};
    const PathShown before = std::exchange(path_shown_, now_shown);
    if (now_shown.change == before.change && now_shown.to <= before.to) return;
    if (now_shown.to == 0) return;
    auto path = path_.loan();
    orca::go::fill_path(route_, pose, *height_, *path);
    path_.push(std::move(path));
  }

  void drive(const Pose2& pose) {
    const orca::go::Target target = next_place(pose);
    push_goal(target);
    const Step step = step_towards(target, pose, limits(), before_);
    before_.near = step.near;
    before_.speed = step.speed;
    if (step.kind != Step::Kind::reached) {
      motion_.push(orca::head(step.direction, step.speed, *weight_));
    } else if (deviation_ <= target.reach_radius) {
      arrive(pose);
    } else {
      wait_to_be_sure();
    }
  }

  // Stands where it believes the goal is: its pose may become surer.
  void wait_to_be_sure() {
    motion_.push(orca::full_stop());
    if (!std::exchange(doubts_, true))
      log_warning("perhaps at \"" + route_.next().name() + "\", but not arrived: " + doubt());
  }

  // Says how unsure the position is, for people.
  [[nodiscard]] std::string doubt() const {
    return "its position is known only to " + in_short(deviation_) + " m, the goal's reach is " +
           in_short(route_.next().reach_radius().distance()) + " m";
  }

  // Pushes the point that it drives to, or a place on the way through a door.
  void push_goal(const orca::go::Target& target) {
    const auto& point = route_.next().coordinate().point();
    if (target.place == orca::Vec2{point.x(), point.y()}) {
      goal_push_.push(orca::copy_value(route_.point()));
      return;
    }
    auto place = orca::make_object(route_.next());
    place->coordinate().point().x(target.place.x);
    place->coordinate().point().y(target.place.y);
    goal_push_.push(std::move(place));
  }

  // Returns whether it has given up the route. It does not as long as nobody wants to know.
  bool is_hopeless(const Pose2& pose) {
    const double stuck = patience_.note(distance(next_place(pose), pose), now());
    const orca::idl::GoalPoint& next = route_.next();
    if (failed_.subscriber_count() == 0 || next.reach_radius().distance() <= 0.0) return false;
    if (next.time_limit() > 0.0 && route_.age(now()) >= next.time_limit()) {
      end_route(orca::idl::GOAL_TIMED_OUT,
                "timed out: not reached within " + in_short(next.time_limit()) + " s");
    } else if (*blocked_after_ > 0.0 && stuck >= *blocked_after_) {
      end_route(orca::idl::GOAL_BLOCKED, "blocked: no nearer than " + in_short(patience_.nearest()) +
                                             " m to " + place() + " for " + in_short(*blocked_after_) + " s" +
                                             (doubts_ ? ", and " + doubt() : ""));
    } else {
      return false;
    }
    return true;
  }

  // Names what the robot drives to now, for people.
  [[nodiscard]] std::string place() const { return route_.next().via() ? "the next via point" : "the goal"; }

  static std::string in_short(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", number);
    return text;
  }

  void end_route(orca::idl::GoalFailure kind, const std::string& reason) {
    const ObjectPtr<orca::idl::GoalPoint> goal = route_.point();
    route_.give_up(goal->mission());
    before_ = {};
    motion_.push(orca::full_stop());
    announce(*goal, kind, reason);
    end_mission();
  }

  void announce(const orca::idl::GoalPoint& goal, orca::idl::GoalFailure kind, const std::string& reason) {
    auto failed = failed_.loan();
    failed->name() = goal.name();
    failed->kind(kind);
    failed->reason() = reason;
    failed->stamp(orca::to_time_value(now()));
    failed_.push(std::move(failed));
  }

  void stop() override {
    before_ = {};
    patience_.begin();
    legs_ = {};
    posed_at_.reset();
  }

  Pose2 take_pose() {
    if (!localizer_.connected()) {
      const auto odometry = odometry_.get_update();
      note_time(odometry->stamp());
      deviation_ = orca::position_deviation(odometry->covariance());
      return orca::plane_pose(*odometry);
    }
    const auto pose = localizer_.get_update();
    note_time(pose->stamp());
    deviation_ = orca::position_deviation(pose->covariance());
    return orca::plane_pose(*pose);
  }

  void note_time(const orca::idl::TimeValue& stamp) {
    const orca::TimePoint time = orca::to_time_point(stamp);
    before_.time = posed_at_ ? orca::to_seconds(time - *posed_at_) : 0.0;
    posed_at_ = time;
  }

  void pass_via_points(const Pose2& pose) {
    while (!route_.empty()) {
      const orca::go::Target place = next_place(pose);
      if (!place.via || !within_reach(place, pose)) return;
      if (legs_.at_last()) route_.pop();
      legs_.pop();
      patience_.begin();
    }
  }

  void arrive(const Pose2& pose) {
    auto arrived = arrived_.loan();
    arrived->name() = route_.next().name();
    arrived->x(pose.x);
    arrived->y(pose.y);
    arrived->stamp(orca::to_time_value(*posed_at_));
    route_.pop();
    before_ = {};
    patience_.begin();
    motion_.push(orca::full_stop());
    arrived_.push(std::move(arrived));
    end_mission();
  }

  // Returns the place that the robot, at `pose`, drives to now.
  const orca::go::Target& next_place(const Pose2& pose) {
    return legs_.next(route_.point(), pose, {*height_, *door_run_up_});
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
  orca::PushServer<orca::idl::GoalFailed> failed_{
      *this, "GoalFailedPush", {.text = "One object per goal given up: refused, blocked or timed out."}};
  orca::PushServer<orca::idl::GoalPoint> goal_push_{
      *this, "GoalPush", {.text = "The via point or goal that it drives to now, once per lap."}};
  orca::PushServer<orca::idl::Path> path_{
      *this,
      "PathPush",
      {.text = "The way that is left: one object whenever its points change, and for a new subscriber."}};
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
  orca::Param<double> blocked_after_{
      *this,
      "blocked_after",
      30.0,
      {.unit = "s",
       .min = 0.0,
       .text = "Time without coming nearer to a point after which its goal is given up; 0: it never is."}};
  orca::Param<double> height_{
      *this, "height", 0.0, {.unit = "m", .text = "Height (z) of the robot in the frame of the goals."}};
  orca::Param<double> door_run_up_{
      *this,
      "door_run_up",
      0.7,
      {.unit = "m",
       .min = 0.2,
       .text = "Distance before a door at which it lines up, and behind it at which it is through."}};
  orca::Param<double> door_room_{
      *this,
      "door_room",
      0.5,
      {.unit = "m", .min = 0.0, .text = "Width that the robot needs; a narrower door is refused."}};
  orca::Param<double> weight_{
      *this,
      "weight",
      1.0,
      {.min = 0.0, .text = "Weight of its wishes, relative to other behaviours; 0: they never count."}};

  // What the subscribers to the path have seen.
  struct PathShown {
    std::uint64_t change = 0;  // of the route
    std::size_t to = 0;        // subscribers
  };

  orca::go::Route route_;
  PathShown path_shown_;
  orca::go::Legs legs_;
  orca::go::Patience patience_;
  orca::go::Before before_;
  std::optional<orca::TimePoint> posed_at_;
  double deviation_ = 0.0;  // [m] standard deviation of its position, in the worst direction; 0: not known
  bool doubts_ = false;     // Whether it has said that it may be at the goal.
};

}  // namespace

ORCA_COMPONENT(Goto, "orca.Goto")
