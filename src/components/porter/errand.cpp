// SPDX-License-Identifier: LGPL-3.0-or-later
#include "errand.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca::porter {
namespace {

constexpr double kAhead = 0.03;     // [rad] so exactly it looks at the place before it drives up to it
constexpr double kTurnGain = 1.5;   // [1/s]
constexpr double kSlowTurn = 0.1;   // [rad/s] turned at least, so that the turn ends
constexpr double kOvershoot = 0.1;  // [m] driven beyond the place where the thing should have been
constexpr double kCrawl = 0.25;     // share of the speed once the thing is between the tips of the paddles
constexpr double kSayAgain = 1.0;   // [s]

double distance_to(Vec2 place, const Pose2& pose) {
  return portable::hypot(place.x - pose.x, place.y - pose.y);
}

// [rad] in the robot frame.
double bearing_of(Vec2 place, const Pose2& pose) {
  return wrapped(portable::atan2(place.y - pose.y, place.x - pose.x) - pose.yaw);
}

Step drive(double direction, double speed) { return {.wish = {.direction = direction, .speed = speed}}; }

Step failure(std::string reason) { return {.kind = Step::Kind::failed, .reason = std::move(reason)}; }

}  // namespace

Step Errand::step(const Pose2& pose, const idl::GripperState& gripper, double time, const Manner& manner) {
  const Scene now{pose, gripper, time, manner};
  if (!began_) {
    began_ = time;
    told_.reset();
    from_ = pose.position();
  }
  Step step = kind_ == Kind::fetch ? fetch(now) : put(now);
  const bool late = began_ && time - *began_ > manner.patience;
  return late && step.kind == Step::Kind::goes_on ? failure(this->late()) : step;
}

void Errand::delay(double time) {
  if (began_) *began_ += time;
}

Step Errand::fetch(const Scene& now) {
  const idl::GripperState& gripper = now.gripper;
  switch (stage_) {
    case Stage::turn: return turn(now);
    case Stage::approach: return approach_thing(now);
    case Stage::close: return close(now);
    case Stage::lift:
      if (gripper.up()) return {.kind = Step::Kind::done};
      return tell(now, idl::PADDLES_STAY, idl::LIFT_UP);
    default:
      if (gripper.open() && gripper.down()) return enter(Stage::turn);
      return tell(now, idl::PADDLES_OPEN, idl::LIFT_DOWN);
  }
}

Step Errand::put(const Scene& now) {
  const idl::GripperState& gripper = now.gripper;
  switch (stage_) {
    case Stage::turn: return turn(now);
    case Stage::approach: return approach_place(now);
    case Stage::lower:
      if (gripper.down()) return enter(Stage::let_go);
      return tell(now, idl::PADDLES_STAY, idl::LIFT_DOWN);
    case Stage::let_go:
      if (gripper.open()) return enter(Stage::back_off);
      return tell(now, idl::PADDLES_OPEN, idl::LIFT_STAY);
    case Stage::back_off: return back_off(now);
    default:
      if (!gripper.holds()) return failure("there is nothing between the paddles to be put down");
      return enter(Stage::turn);
  }
}

// It turns more slowly the less is left.
Step Errand::turn(const Scene& now) {
  const double left = bearing_of(place_, now.pose);
  if (std::abs(left) <= kAhead) return enter(Stage::approach);
  const double rate = std::clamp(kTurnGain * std::abs(left), kSlowTurn, now.manner.turn_rate);
  return {.wish = {.turn_rate = std::copysign(rate, left)}};
}

// The beam says that the thing is between the paddles; how far away it was is not known so well.
Step Errand::approach_thing(const Scene& now) {
  if (now.gripper.inner_beam()) return enter(Stage::close);
  if (distance_to(place_, now.pose) < now.manner.reach - kOvershoot)
    return failure("nothing came between the paddles where the thing should stand");
  const double share = now.gripper.outer_beam() ? kCrawl : 1.0;
  return drive(bearing_of(place_, now.pose), share * now.manner.approach_speed);
}

Step Errand::approach_place(const Scene& now) {
  if (!now.gripper.holds()) return failure("it has lost what was between the paddles");
  if (distance_to(place_, now.pose) <= now.manner.reach) return enter(Stage::lower);
  return drive(bearing_of(place_, now.pose), now.manner.approach_speed);
}

Step Errand::close(const Scene& now) {
  if (now.gripper.holds()) return enter(Stage::lift);
  if (now.gripper.closed()) return failure("the paddles have closed on nothing");
  return tell(now, idl::PADDLES_CLOSE, idl::LIFT_STAY);
}

Step Errand::back_off(const Scene& now) {
  if (distance_to(from_, now.pose) >= now.manner.back_off) return {.kind = Step::Kind::done};
  return drive(0.0, -now.manner.approach_speed);
}

Step Errand::tell(const Scene& now, idl::PaddleMotion paddles, idl::LiftMotion lift) {
  if (told_ && now.time - *told_ < kSayAgain) return {};
  told_ = now.time;
  Step step;
  step.gripper.emplace();
  step.gripper->paddles(paddles);
  step.gripper->lift(lift);
  return step;
}

// The robot stands for the lap in between.
Step Errand::enter(Stage stage) {
  stage_ = stage;
  began_.reset();
  return {};
}

const char* Errand::late() const {
  switch (stage_) {
    case Stage::open: return "the gripper does not open and go down";
    case Stage::look:
    case Stage::turn: return "the robot does not turn to the place";
    case Stage::approach: return "the robot does not get to the place";
    case Stage::close: return "the paddles do not close";
    case Stage::lift: return "the lift does not go up";
    case Stage::lower: return "the lift does not go down";
    case Stage::let_go: return "the paddles do not open";
    case Stage::back_off: return "the robot does not drive back";
  }
  return "";
}

}  // namespace orca::porter
