// SPDX-License-Identifier: LGPL-3.0-or-later
#include "docking.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca::dock {
namespace {

constexpr double kLookAhead = 0.25;  // [m] along the axis
constexpr double kTurnFirst = 0.2;   // [rad] off the way, from which it turns on the spot
constexpr double kTurnGain = 1.5;    // [1/s]
constexpr double kTurnRate = 0.3;    // [rad/s] at most
constexpr double kMoves = 0.01;      // [m] A robot that moves less than this in kHeld is held.
constexpr double kHeld = 1.0;        // [s]
constexpr double kSlow = 30.0;       // [s] for driving up or back, after which something holds it

double limited(double rate) { return std::clamp(rate, -kTurnRate, kTurnRate); }

}  // namespace

Step Docking::step(const Pose2& robot, bool charges, double time, const Manner& manner) {
  if (!began_) (void)enter(Stage::approach, robot, time);
  switch (stage_) {
    case Stage::look: return look(robot, charges, time, manner);
    case Stage::back_off: return back_off(robot, time, manner);
    case Stage::approach: return approach(robot, time, manner.speed);
  }
  return {};
}

void Docking::delay(double time) {
  if (began_) *began_ += time;
  held_since_ += time;
}

// A robot whose middle is at the contacts has found nothing to touch. One whose pose jitters may seem to move although the charger holds it.
Step Docking::approach(const Pose2& robot, double time, double speed) {
  if (robot.x >= 0.0 || time - *began_ > kSlow) return enter(Stage::look, robot, time);
  const double bearing = wrapped(portable::atan2(-robot.y, kLookAhead) - robot.yaw);
  if (std::fabs(bearing) > kTurnFirst) {
    held_since_ = time;
    return {.turn_rate = limited(kTurnGain * bearing)};
  }
  if (is_held(robot, time)) return enter(Stage::look, robot, time);
  return {.speed = speed, .turn_rate = limited(2.0 * speed * portable::sin(bearing) / kLookAhead)};
}

bool Docking::is_held(const Pose2& robot, double time) {
  if (norm(robot.position() - from_) > kMoves) {
    from_ = robot.position();
    held_since_ = time;
  }
  return time - held_since_ > kHeld;
}

Step Docking::look(const Pose2& robot, bool charges, double time, const Manner& manner) {
  if (charges) return {.kind = Step::Kind::done};
  if (time - *began_ <= manner.patience) return {};
  return enter(Stage::back_off, robot, time);
}

// It drives back along the axis: the next time it is nearer to it.
Step Docking::back_off(const Pose2& robot, double time, const Manner& manner) {
  const bool is_away = norm(robot.position() - from_) >= manner.back_off;
  if (!is_away && time - *began_ <= kSlow) return {.speed = -manner.speed, .turn_rate = limited(-robot.yaw)};
  if (attempt_ >= manner.attempts)
    return {.kind = Step::Kind::failed,
            .reason = "the battery is not charged there; is the charger on, and are its contacts clean?"};
  attempt_ += 1.0;
  return enter(Stage::approach, robot, time);
}

// The robot stands for the lap in between.
Step Docking::enter(Stage stage, const Pose2& robot, double time) {
  stage_ = stage;
  began_ = time;
  from_ = robot.position();
  held_since_ = time;
  return {};
}

}  // namespace orca::dock
