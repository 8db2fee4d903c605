// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithm.hpp"
#include "orca/goals/goal_follower.hpp"
#include "orca/planning/asked_robot.hpp"

namespace {

/// A behaviour that drives to a goal in a straight line (thesis 11.1). It circles around a goal whose
/// reach_radius is 0 until another goal comes. A base that can move sideways does, and turns on the way. A goal may lie above or below the robot: its reach is a ball.
/// It treats goals, via points and doors as all behaviours that follow goals.
class Goto final : public orca::go::GoalFollower {
 public:
  explicit Goto(orca::ComponentHost& host) : GoalFollower(host, kBlockedAfter) {}

 private:
  static constexpr double kBlockedAfter = 30.0;  // [s]

  orca::Status start() override {
    if (orca::Status begun = GoalFollower::start(); !begun.ok()) return begun;
    slides_ = false;
    return robot_.ask();
  }

  void stop() override {
    robot_.leave();
    GoalFollower::stop();
  }

  orca::Outcome work() override {
    if (const orca::Status learnt = robot_.learn(); !learnt.ok())
      log_warning(learnt.error().text() + "; it drives as a base that cannot move sideways");
    slides_ = slides_ || robot_.slides();
    return GoalFollower::work();
  }

  void save_state(orca::StateWriter& state) const override {
    GoalFollower::save_state(state);
    state.write(slides_);
  }

  orca::Status load_state(orca::StateReader& state) override {
    if (orca::Status read = GoalFollower::load_state(state); !read.ok()) return read;
    return state.read(slides_);
  }

  void drive(const orca::Pose2& pose, const orca::go::Target& target) override {
    take(step_towards(target, pose, limits(), before()), pose, target);
  }

  [[nodiscard]] std::uint32_t state_version() const override { return 3; }

  [[nodiscard]] orca::go::Limits limits() const {
    return {*max_speed_, *slow_down_, *min_speed_, *turn_in_place_, *deceleration_, *circle_radius_, slides_};
  }

  orca::planning::AskedRobot robot_{*this, "Base that is asked whether it can move sideways."};
  bool slides_ = false;  // Whether it has said so.

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
};

}  // namespace

ORCA_COMPONENT(Goto, "orca.Goto")
