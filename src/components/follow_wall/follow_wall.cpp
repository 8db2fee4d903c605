// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/avoidance/ring_ear.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/geometry/objects/own_beams.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/planning/asked_robot.hpp"
#include "wall.hpp"

namespace {

/// A behaviour that drives along a wall, at a distance and on a side, by what sonars hear. See README.md.
class FollowWall final : public orca::Component {
 public:
  explicit FollowWall(orca::ComponentHost& host) : Component(host) { lap_on(odometry_); }

 private:
  static constexpr double kDeafAfter = 0.6;   // [s] without a firing
  static constexpr double kLooksBack = 10.0;  // [s] for which it turns back to a wall that it has lost
  static constexpr double kBack = 0.25;       // [rad] It drives a circle of about half a metre then.
  static constexpr double kLeast = 0.1;       // [m] to keep where there is not so much room

  orca::Status configure() override { return robot_.check(); }

  orca::Status start() override {
    motion_.start(lap_period());
    memory_.clear();
    ear_.clear();
    heard_at_.reset();
    moved_at_.reset();
    follows_ = false;
    followed_at_.reset();
    return robot_.ask();
  }
  void stop() override { robot_.leave(); }

  orca::Outcome work() override {
    if (const orca::Status learnt = robot_.learn(); !learnt.ok()) return orca::failed(learnt.error().text());
    const bool moves = follow(*odometry_.get_update());
    if (sonar_.new_data_arrived()) listen(*sonar_.get_update());
    const bool hears = heard_at_ && orca::to_seconds(now() - *heard_at_) <= kDeafAfter;
    if (moves && hears && robot_.body()) {
      drive();
    } else {
      motion_.push(orca::full_stop());
    }
    return orca::again();
  }

  // Returns whether it knows how the robot moves.
  bool follow(const orca::idl::Odometry& odometry) {
    if (!senders_.accepts(odometry) ||
        !senders_.accepts(odometry,
                          orca::check_age(age_of(orca::to_time_point(odometry.stamp())), kDeafAfter)))
      return false;
    if (odometer_.begins_anew(odometry)) {  // what it remembers lies elsewhere now
      memory_.clear();
      moved_at_.reset();
    }
    const orca::TimePoint stamp = orca::to_time_point(odometry.stamp());
    const orca::Pose2 pose = orca::plane_pose(odometry);
    if (moved_at_) memory_.advance(seen_from(pose_, pose), orca::to_seconds(stamp - *moved_at_), kKeep);
    moved_at_ = stamp;
    pose_ = pose;
    twist_ = {odometry.translational_velocity(), odometry.sideways_velocity(), odometry.steering_velocity()};
    return true;
  }

  void listen(const orca::idl::SonarRangeReadings& round) {
    const auto last = orca::avoid::RingEar::last_firing(round);
    const bool sound = senders_.accepts(round) && senders_.accepts(round, orca::check_view_ahead(round)) &&
                       (!last || senders_.accepts(round, orca::avoid::check_firing(age_of(*last), kDeafAfter,
                                                                                   "sonar", "fired")));
    heard_at_ = sound ? std::optional(now()) : std::nullopt;
    if (!sound || !moved_at_) return;
    ear_.take(round, now(), false, [&](orca::Vec2 echo, orca::TimePoint fired) {
      memory_.hear(seen_from(orca::moved(twist_, orca::to_seconds(*moved_at_ - fired)), echo), kKeep);
    });
  }

  [[nodiscard]] double age_of(orca::TimePoint stamp) const { return orca::to_seconds(now() - stamp); }

  // A sonar invents echoes, but not twice in the same place.
  void drive() {
    confirmed_.clear();
    for (std::size_t i = 0; i < memory_.echoes().size(); ++i)
      if (memory_.is_confirmed(i)) confirmed_.push_back(memory_.echoes()[i]);
    orca::wall::Step step = orca::wall::step_along(confirmed_, {.side = side(),
                                                                .radius = robot_.body()->radius,
                                                                .distance = *distance_,
                                                                .least = std::min(kLeast, *distance_),
                                                                .max_speed = *max_speed_});
    if (step.follows != std::exchange(follows_, step.follows))
      log_info(step.follows ? "follows a wall on its " + *side_ : "looks for a wall");
    if (step.follows) followed_at_ = now();
    if (!step.follows && followed_at_ && orca::to_seconds(now() - *followed_at_) < kLooksBack)
      step.direction = side() == orca::wall::Side::left ? kBack : -kBack;
    show(step);
    motion_.push(orca::head(step.direction, step.speed, *weight_));
  }

  void show(const orca::wall::Step& step) {
    const orca::Vec2 aim = pose_ * (orca::wall::kStep * orca::direction(step.direction));
    auto goal = goal_.loan();
    goal->name() = "wall";
    goal->coordinate().point().x(aim.x);
    goal->coordinate().point().y(aim.y);
    goal->via(true);
    goal_.push(std::move(goal));
  }

  [[nodiscard]] orca::wall::Side side() const {
    return *side_ == "left" ? orca::wall::Side::left : orca::wall::Side::right;
  }

  // As SonarAvoid, but for farther walls, and until the next round has confirmed an echo.
  static constexpr orca::avoid::EchoMemory::Limits kKeep{
      .confirmed_time = 2.0, .single_time = 0.5, .same_place = 0.1, .range = 1.5};

  orca::PushProxy<orca::idl::Odometry> odometry_{*this, "odometry", {.text = "Motion of the robot."}};
  orca::PushProxy<orca::idl::SonarRangeReadings> sonar_{*this, "sonar", {.text = "Readings of the sonars."}};
  orca::planning::AskedRobot robot_{*this, "Base that is asked how large the robot is."};
  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this, "MotionCmdPush", {.text = "One command per lap: full stop while it hears nothing."}};
  orca::PushServer<orca::idl::GoalPoint> goal_{
      *this,
      "GoalPush",
      {.text =
           "The place beside the wall that it drives to now, in the frame of the odometry, once per lap."}};
  orca::Param<std::string> side_{
      *this,
      "side",
      "left",
      {.choices = {"left", "right"}, .text = "Side of the robot on which the wall is."}};
  orca::Param<double> distance_{
      *this,
      "distance",
      0.4,
      {.unit = "m",
       .min = 0.1,
       .max = 1.0,
       .text = "Distance to keep between the wall and the circle that holds the robot."}};
  orca::Param<double> max_speed_{
      *this, "max_speed", 0.3, {.unit = "m/s", .min = 0.05, .text = "Speed along a straight wall."}};
  orca::Param<double> weight_{
      *this,
      "weight",
      1.0,
      {.min = 0.0, .text = "Weight of its wishes, relative to other behaviours; 0: they never count."}};

  orca::SenderWatch senders_{host()};
  orca::SenderLife odometer_;
  orca::avoid::RingEar ear_;
  orca::avoid::EchoMemory memory_;
  std::vector<orca::Vec2> confirmed_;
  orca::Pose2 pose_;  // in the frame of the odometry
  orca::Twist2 twist_;
  std::optional<orca::TimePoint> moved_at_;
  std::optional<orca::TimePoint> heard_at_;
  bool follows_ = false;
  std::optional<orca::TimePoint> followed_at_;
};

}  // namespace

ORCA_COMPONENT(FollowWall, "orca.FollowWall")
