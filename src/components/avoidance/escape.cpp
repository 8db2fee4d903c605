// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/escape.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace orca::avoid {
namespace {

constexpr Duration kStuckAfter = 1s;
constexpr Duration kLongest = 5s;
constexpr double kWayBack = 0.1;     // [m]
constexpr double kMovedOn = 0.04;    // [m] or
constexpr double kTurnedOn = 0.1;    // [rad] that count as having moved on
constexpr double kFacing = 0.2;      // [rad] off the goal: it need not turn any more
constexpr double kFarTurn = 0.8;     // [rad] more than that is not looked at at once
constexpr double kTurnRate = 0.5;    // [rad/s]
constexpr double kStill = 0.005;     // [m/s]
constexpr double kStillTurn = 0.01;  // [rad/s]

bool stands_still(const Twist2& twist) {
  return speed_of(twist) < kStill && std::abs(twist.turn_rate) < kStillTurn;
}

bool has_moved(const Pose2& from, const Pose2& to) {
  return norm(to.position() - from.position()) > kMovedOn || std::abs(wrapped(to.yaw - from.yaw)) > kTurnedOn;
}

}  // namespace

std::optional<nav::Steer> Escape::step(const Moment& moment) {
  has_just_begun_ = false;
  if (!since_) {
    retreat_.note(moment.pose);
    if (!is_stuck(moment)) return std::nullopt;
    has_just_begun_ = true;
    since_ = moment.now;
    from_ = moment.pose;
    retreat_.reset();
    retreat_.begin();
  }
  const nav::Steer steer = way_out(moment);
  if (!is_done(steer, moment)) return steer;
  since_.reset();
  stands_since_.reset();
  ended_at_ = moment.pose;
  return std::nullopt;
}

bool Escape::is_stuck(const Moment& moment) {
  if (ended_at_ && has_moved(*ended_at_, moment.pose)) ended_at_.reset();
  if (!moment.goal || !stands_still(moment.twist))
    stands_since_.reset();
  else if (!stands_since_)
    stands_since_ = moment.now;
  return stands_since_ && !ended_at_ && moment.now - *stands_since_ > kStuckAfter;
}

nav::Steer Escape::way_out(const Moment& moment) {
  std::vector<Vec2> points;
  for (const Vec2 echo : moment.echoes) points.push_back(moment.pose * echo);
  const nav::Scene scene{.pose = moment.pose, .speed = moment.twist.forward, .points = points};
  const nav::Steer back =
      retreat_.step(moment.now, scene, [&](Vec2 point) { return moment.floor.has(point); });
  if (!back.blocked && back.speed < 0.0) return back;
  // The unseen obstacle is ahead. Between sonars there may be a wall for its corners.
  const bool knows_shapes = outline_.is_circle() || !moment.floor.empty();
  if (!moment.goal || !knows_shapes) return {.blocked = true};
  const double angle = std::clamp(*moment.goal, -kFarTurn, kFarTurn);
  return nav::turn_on_the_spot(angle, scene, outline_, {.turn_rate = kTurnRate});
}

bool Escape::is_done(const nav::Steer& steer, const Moment& moment) const {
  if (steer.blocked || !moment.goal || moment.now - *since_ > kLongest) return true;
  if (steer.turning) return std::abs(*moment.goal) < kFacing;
  return norm(moment.pose.position() - from_.position()) >= kWayBack;
}

}  // namespace orca::avoid
