// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "docking.hpp"
#include "orca/base/text.hpp"
#include "orca/component.hpp"
#include "orca/component/held_motors.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/goals/goal_relay.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"

namespace {

using orca::Pose2;
using orca::dock::Docking;
using orca::dock::Step;

/// A behaviour that docks at chargers. It takes goals in the place of Goto, to which it passes them on. At a goal whose name is one of `docks` the robot
/// stops some way before the place, and this behaviour does the rest: the goal is reached when the battery is charged. Before a robot that is charged
/// drives elsewhere, it drives back from the charger. See README.md.
class Dock final : public orca::Component {
 public:
  explicit Dock(orca::ComponentHost& host) : Component(host) { lap_on(localizer_); }

 private:
  orca::Status start() override {
    motion_.start(lap_period());
    return orca::ok();
  }

  orca::Status on_goal(const orca::ObjectPtr<orca::idl::GoalPoint>& goal) {
    // Its points may be sent again, along another way, when the robot is there already.
    const bool goes_on = relay_.goal() && goal->mission() == relay_.goal()->mission();
    if (docking_ && goes_on) return orca::ok();
    if (orca::Status sound = relay_.keep(goal); !sound.ok()) return sound;
    if (!goes_on) waiting_.clear();
    docking_.reset();
    waiting_.push_back(goal);
    return orca::ok();
  }

  [[nodiscard]] bool is_dock(const orca::idl::GoalPoint& goal) const {
    return !goal.via() && std::ranges::find(*docks_, goal.name()) != docks_->end();
  }

  orca::Outcome work() override {
    const auto here = localizer_.get_update();
    while (const auto arrived = relay_.next_arrival()) hear(*arrived);
    while (const auto failed = relay_.next_failure()) relay_.end_as(*failed, relay_.goal()->name());
    const double age = orca::to_seconds(now() - orca::to_time_point(here->stamp()));
    const bool knows = senders_.accepts(*here) && senders_.accepts(*here, orca::check_age(age, kOldest)) &&
                       !orca::is_anywhere(here->covariance());
    if (knows) pose_ = orca::plane_pose(*here), known_at_ = now();
    delay(held_.since_last(now(), kept_alarms()));
    if (!waiting_.empty() && leave()) return orca::again();
    pass_on();
    if (!docking_) {
      motion_.push(orca::dont_care());
    } else if (knows || charges()) {
      go_on();
    } else {
      wait_for_pose();
    }
    return orca::again();
  }

  // The robot does not move while its motors are held, as those of some bases are at their chargers.
  void delay(orca::Duration time) {
    if (docking_) docking_->delay(orca::to_seconds(time));
    if (leaves_since_) *leaves_since_ += time;
  }

  // With its nose at a charger a robot may lose for a moment where it is.
  void wait_for_pose() {
    motion_.push(orca::full_stop());
    if (orca::to_seconds(now() - known_at_) > kLost)
      give_up(orca::idl::GOAL_UNANSWERED, "lost: it is not known any more where the robot is");
  }

  // Drives back from a charger before anybody turns the robot there. It needs no pose: with its nose at a wall a robot may not know where it is.
  // @return whether it does.
  bool leave() {
    if (!leaves_since_ && (docked_ || charges())) leaves_since_ = now();
    if (!leaves_since_) return false;
    const double way = *speed_ * orca::to_seconds(now() - *leaves_since_);
    if (way >= *back_off_) {
      leaves_since_.reset();
      docked_.reset();
      return false;
    }
    show(docked_.value_or(orca::Vec2{kNose, 0.0}) + orca::Vec2{way, 0.0});
    motion_.push(orca::turn(0.0, -*speed_, *weight_));
    return true;
  }

  void pass_on() {
    for (const auto& goal : std::exchange(waiting_, {})) {
      const orca::Status sent = is_dock(*goal) ? send_before(*goal) : relay_.pass_on(copy_value(goal));
      if (!sent.ok()) return give_up(orca::idl::GOAL_REFUSED, "refused: " + sent.error().text());
    }
  }

  // Sends the robot to the place before the charger, where it is to look in its direction.
  orca::Status send_before(const orca::idl::GoalPoint& goal) {
    const auto yaw = direction_of(goal);
    if (!yaw) return yaw.error();
    X_WD_ = {goal.coordinate().point().x(), goal.coordinate().point().y(), *yaw};
    const Pose2 before = X_WD_ * Pose2{-*standoff_, 0.0, 0.0};
    auto near = orca::make_object(goal);
    near->name() = "before_" + goal.name();
    near->coordinate().point().x(before.x);
    near->coordinate().point().y(before.y);
    near->reach_radius().distance(kNear);
    near->use_orientation(true);
    near->orientation().orientation().yaw(before.yaw);
    near->reach_angle(kNear);
    return relay_.pass_on(std::move(near));
  }

  orca::Result<double> direction_of(const orca::idl::GoalPoint& goal) {
    if (goal.use_orientation()) return goal.orientation().orientation().yaw();
    if (!places_.connected())
      return orca::fail(orca::Code::failed_precondition,
                        "nobody says from where " + orca::in_quotes(goal.name()) +
                            " is driven to; give the goal a direction, or connect the port \"places\"");
    auto question = places_.loan();
    question->about() = goal.name();
    const auto answer = places_.query(std::move(question));
    if (!answer) return answer.error();
    return (*answer)->orientation().orientation().yaw();
  }

  // Goto has done its part when the robot is before the charger.
  void hear(const orca::idl::Arrived& arrived) {
    const auto& goal = *relay_.goal();
    if (is_dock(goal)) {
      if (arrived.name() == "before_" + goal.name()) docking_.emplace();
      return;
    }
    if (arrived.name() != goal.name()) return;  // The points of another way are coming.
    relay_.end_as(arrived);
  }

  [[nodiscard]] bool charges() const {
    const auto battery = battery_.latest();
    return battery && battery->charging() &&
           orca::to_seconds(now() - orca::to_time_point(battery->creation_time())) <= kFresh;
  }

  void go_on() {
    const Pose2 robot = seen_from(X_WD_, pose_);
    const Step step = docking_->step(robot, charges(), orca::to_seconds(now()),
                                     {*speed_, *back_off_, *patience_, static_cast<double>(*attempts_)});
    const orca::Vec2 contacts = seen_from(robot, orca::Vec2{});
    if (step.kind == Step::Kind::done) return conclude(contacts);
    if (step.kind == Step::Kind::failed) return give_up(orca::idl::GOAL_UNDONE, "undone: " + step.reason);
    show(contacts);
    motion_.push(orca::turn(step.turn_rate, step.speed, *weight_));
  }

  // Says to the gate what the robot is to touch, in the frame of the robot.
  void show(orca::Vec2 contacts) {
    auto place = touch_.loan();
    place->coordinate().point().x(contacts.x);
    place->coordinate().point().y(contacts.y);
    place->reach_radius().distance(kFace);
    touch_.push(std::move(place));
  }

  void conclude(orca::Vec2 contacts) {
    relay_.report_arrival(pose_);
    docked_ = contacts;
    end_work();
  }

  void give_up(orca::idl::GoalFailure kind, const std::string& reason) {
    if (!relay_.goal()) return;
    relay_.report_failure(kind, reason);
    end_work();
  }

  void end_work() {
    docking_.reset();
    motion_.push(orca::full_stop());
    relay_.end();
  }

  void save_state(orca::StateWriter& state) const override {
    state.write(relay_.task(), waiting_, X_WD_, docking_, docked_, leaves_since_, pose_, known_at_);
  }
  orca::Status load_state(orca::StateReader& state) override {
    return state.read(relay_.task(), waiting_, X_WD_, docking_, docked_, leaves_since_, pose_, known_at_);
  }
  [[nodiscard]] std::uint32_t state_version() const override { return 2; }

  static constexpr double kNear = 0.1;  // [m], [rad] to which Goto brings the robot before a charger
  static constexpr double kFace = 0.4;  // [m] around the contacts, what the robot may touch there
  static constexpr double kNose =
      0.25;  // [m] to the contacts of a charger at which the robot was switched on
  static constexpr double kLost = 10.0;   // [s]
  static constexpr double kOldest = 1.0;  // [s] An older pose says where the robot was.
  static constexpr double kFresh = 3.0;   // [s] Batteries are read once a second, or in ten.

  orca::go::GoalRelay relay_{
      *this,
      host(),
      &Dock::on_goal,
      {.driver = "Goto",
       .done = "One object per goal reached; at a charger when the battery is charged.",
       .undone = "One object per goal not reached, or where the battery is not charged."}};
  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this, "motion", {.text = "One command per lap: a wish at a charger, no opinion elsewhere."}};
  orca::PushServer<orca::idl::GoalPoint> touch_{
      *this,
      "TouchPush",
      {.text = "The contacts that the robot is to touch, in its own frame, once per lap at a charger."}};

  orca::PushProxy<orca::idl::RobotPose> localizer_{
      *this, "localizer", {.text = "Pose of the robot, in the frame of the goals."}};
  orca::PushProxy<orca::idl::Battery> battery_{
      *this, "battery", {.text = "The battery, which says whether it is charged."}};
  orca::QueryProxy<orca::idl::Ask, orca::idl::GoalPoint> places_{
      *this,
      "places",
      {.text = "Asked for the direction of a charger that a goal gives without one: a PlaceServer.",
       .optional = true}};

  orca::Param<std::vector<std::string>> docks_{
      *this, "docks", {"dock"}, {.text = "Names of the goals that are chargers."}};
  orca::Param<double> standoff_{
      *this,
      "standoff",
      0.8,
      {.unit = "m",
       .min = 0.0,
       .text = "Distance from the contacts to the middle of the robot, from where on it creeps."}};
  orca::Param<double> speed_{
      *this,
      "speed",
      0.05,
      {.unit = "m/s", .min = 0.02, .max = 0.05, .text = "Speed at which it touches the contacts."}};
  orca::Param<double> back_off_{
      *this, "back_off", 0.4, {.unit = "m", .min = 0.0, .text = "How far it drives back from a charger."}};
  orca::Param<double> patience_{
      *this,
      "patience",
      4.0,
      {.unit = "s", .min = 0.1, .text = "Time for which it waits at the contacts until it is charged."}};
  orca::Param<std::int64_t> attempts_{
      *this, "attempts", 3, {.min = 1, .text = "Attempts after which the goal is given up."}};
  orca::Param<double> weight_{*this,
                              "weight",
                              100.0,
                              {.min = 0.0,
                               .text = "Weight of its wishes, relative to other behaviours, which are not to "
                                       "turn a robot at a charger; 0: they "
                                       "never count."}};

  std::vector<orca::ObjectPtr<orca::idl::GoalPoint>> waiting_;  // that Goto does not have yet
  orca::SenderWatch senders_{host()};
  orca::HeldTime held_;
  Pose2 X_WD_;                        // of the charger that the goal is
  std::optional<Docking> docking_;    // from when the robot is before it
  std::optional<orca::Vec2> docked_;  // the contacts in the frame of the robot, since it was charged there
  std::optional<orca::TimePoint> leaves_since_;
  Pose2 pose_;                  // the last that was known,
  orca::TimePoint known_at_{};  // when
};

}  // namespace

ORCA_COMPONENT(Dock, "orca.Dock")
