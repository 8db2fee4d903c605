// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "errand.hpp"
#include "orca/component.hpp"
#include "orca/component/held_motors.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/goals/goal_relay.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace {

using orca::porter::Errand;
using orca::porter::Manner;
using orca::porter::Step;

/// A behaviour that fetches things with a gripper and puts them down elsewhere. It takes goals in the place of Goto, to which
/// it passes them on. At a goal whose name is one of those to fetch at, or to put down at, the robot stops some way before the
/// place, and this behaviour does the rest. The goal is then reached when the thing is lifted, or stands there.
class Porter final : public orca::Component {
 public:
  explicit Porter(orca::ComponentHost& host) : Component(host) { lap_on(localizer_); }

 private:
  orca::Status params_changed() override {
    for (const std::string& name : *put_at_)
      if (std::ranges::find(*fetch_at_, name) != fetch_at_->end())
        return put_at_.refuse("\"" + name + "\" is a goal to fetch at, too; it must be one of the two");
    return orca::ok();
  }

  orca::Status start() override {
    motion_.start(lap_period());
    return orca::ok();
  }

  orca::Status on_goal(const orca::ObjectPtr<orca::idl::GoalPoint>& goal) {
    // Its points may be sent again, along another way, when the robot is there already.
    if (errand_ && relay_.goal() && goal->mission() == relay_.goal()->mission()) return orca::ok();
    if (orca::Status sound = relay_.keep(goal); !sound.ok()) return sound;
    errand_.reset();
    if (!kind_of(*goal)) return relay_.pass_on(copy_value(goal));
    auto near = orca::make_object(*goal);
    near->name() = "near_" + goal->name();
    near->reach_radius().distance(*standoff_);
    near->use_orientation(false);
    return relay_.pass_on(std::move(near));
  }

  // Returns what is to be done at the goal, if it is one of those where something is.
  [[nodiscard]] std::optional<Errand::Kind> kind_of(const orca::idl::GoalPoint& goal) const {
    const auto is_in = [&](const std::vector<std::string>& names) {
      return !goal.via() && std::ranges::find(names, goal.name()) != names.end();
    };
    if (is_in(*fetch_at_)) return Errand::Kind::fetch;
    if (is_in(*put_at_)) return Errand::Kind::put;
    return std::nullopt;
  }

  orca::Outcome work() override {
    const auto here = localizer_.get_update();
    while (const auto arrived = relay_.next_arrival()) hear(*arrived);
    while (const auto failed = relay_.next_failure()) relay_.end_as(*failed, relay_.goal()->name());
    if (!senders_.accepts(*here) || orca::is_anywhere(here->covariance())) {
      motion_.push(errand_ ? orca::full_stop() : orca::dont_care());
      return orca::again();
    }
    const orca::Pose2 pose = orca::plane_pose(*here);
    if (errand_) {
      do_errand(pose);
    } else {
      motion_.push(orca::dont_care());
    }
    return orca::again();
  }

  // Goto has done its part when the robot is as near as it was to bring it.
  void hear(const orca::idl::Arrived& arrived) {
    const auto& goal = *relay_.goal();
    if (const auto kind = kind_of(goal)) {
      errand_.emplace(*kind, place_of(goal));
      heard_ = now();
      return;
    }
    if (arrived.name() != goal.name()) return;  // The points of another way are coming.
    relay_.end_as(arrived);
  }

  [[nodiscard]] static orca::Vec2 place_of(const orca::idl::GoalPoint& goal) {
    return {goal.coordinate().point().x(), goal.coordinate().point().y()};
  }

  void do_errand(const orca::Pose2& pose) {
    errand_->delay(orca::to_seconds(held_.since_last(now(), kept_alarms())));
    const auto gripper = gripper_state_.latest();
    const auto age_of = [&](const orca::idl::GripperState& state) {
      return orca::to_seconds(now() - orca::to_time_point(state.stamp()));
    };
    if (!gripper || !orca::check_age(age_of(*gripper), *deaf_after_).ok()) {
      motion_.push(orca::full_stop());
      if (orca::to_seconds(now() - heard_) > *patience_) give_up("the gripper says nothing of its state");
      return;
    }
    heard_ = now();
    const Step step = errand_->step(pose, *gripper, orca::to_seconds(now()), manner());
    push(step.wish);
    if (step.gripper)
      if (const orca::Status told = gripper_.send(*step.gripper); !told.ok())
        log_warning("the gripper was not told what to do: " + told.error().text());
    if (step.kind == Step::Kind::done) conclude(pose);
    if (step.kind == Step::Kind::failed) give_up(step.reason);
  }

  void push(const orca::porter::Wish& wish) {
    motion_.push(wish.speed != 0.0 ? orca::turn(*steer_gain_ * wish.direction, wish.speed, *weight_)
                                   : orca::turn(wish.turn_rate, 0.0, *weight_));
  }

  void conclude(const orca::Pose2& pose) {
    relay_.report_arrival(pose);
    end_errand();
  }

  void give_up(const std::string& reason) {
    relay_.report_failure(orca::idl::GOAL_UNDONE, "undone: " + reason);
    end_errand();
  }

  void end_errand() {
    errand_.reset();
    motion_.push(orca::full_stop());
    relay_.end();
  }

  [[nodiscard]] Manner manner() const {
    return {*reach_, *approach_speed_, *turn_rate_, *back_off_, *patience_};
  }

  void save_state(orca::StateWriter& state) const override { state.write(relay_.task(), errand_, heard_); }
  orca::Status load_state(orca::StateReader& state) override {
    return state.read(relay_.task(), errand_, heard_);
  }
  [[nodiscard]] std::uint32_t state_version() const override { return 2; }

  orca::go::GoalRelay relay_{*this,
                             host(),
                             &Porter::on_goal,
                             {.driver = "Goto",
                              .done = "One object per goal reached, with what was to be done there.",
                              .undone = "One object per goal not reached, or where the gripper failed."}};
  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this, "motion", {.text = "One command per lap: a wish at such a place, no opinion elsewhere."}};

  orca::PushProxy<orca::idl::RobotPose> localizer_{
      *this, "localizer", {.text = "Pose of the robot, in the frame of the goals."}};
  orca::SendProxy<orca::idl::GripperCommand> gripper_{*this, "gripper", {.text = "Commands to the gripper."}};
  orca::PushProxy<orca::idl::GripperState> gripper_state_{
      *this, "gripper_state", {.text = "State of the gripper."}};

  orca::Param<std::vector<std::string>> fetch_at_{
      *this, "fetch_at", {}, {.text = "Names of the goals where the robot is to fetch what stands there."}};
  orca::Param<std::vector<std::string>> put_at_{
      *this, "put_at", {}, {.text = "Names of the goals where the robot is to put down what it holds."}};
  orca::Param<double> reach_{
      *this,
      "reach",
      0.26,
      {.unit = "m",
       .min = 0.0,
       .text = "From the middle of the robot to the inner beam of its gripper, where it holds things."}};
  orca::Param<double> standoff_{
      *this,
      "standoff",
      1.0,
      {.unit = "m",
       .min = 0.0,
       .text = "Distance from the place at which Goto begins to stop; then it turns to the place."}};
  orca::Param<double> approach_speed_{
      *this,
      "approach_speed",
      0.1,
      {.unit = "m/s", .min = 0.01, .text = "Speed at which it drives up to the place, and back."}};
  orca::Param<double> turn_rate_{
      *this, "turn_rate", 0.5, {.unit = "rad/s", .min = 0.05, .text = "Greatest turn rate on the spot."}};
  orca::Param<double> steer_gain_{
      *this,
      "steer_gain",
      1.0,
      {.unit = "1/s", .min = 0.0, .text = "Turn rate per radian off the place, while it drives up to it."}};
  orca::Param<double> back_off_{
      *this,
      "back_off",
      0.3,
      {.unit = "m", .min = 0.0, .text = "How far it drives back from what it has put down."}};
  orca::Param<double> patience_{
      *this,
      "patience",
      20.0,
      {.unit = "s", .min = 0.1, .text = "Longest time for each step at such a place."}};
  orca::Param<double> deaf_after_{
      *this,
      "deaf_after",
      0.6,
      {.unit = "s", .min = 0.0, .text = "The robot stands after this time without news of the gripper."}};
  orca::Param<double> weight_{
      *this,
      "weight",
      1.0,
      {.min = 0.0, .text = "Weight of its wishes, relative to other behaviours; 0: they never count."}};

  orca::SenderWatch senders_{host()};
  orca::HeldTime held_;
  std::optional<Errand> errand_;  // from when the robot is there
  orca::TimePoint heard_{};       // when the gripper has said something, in an errand
};

}  // namespace

ORCA_COMPONENT(Porter, "orca.Porter")
