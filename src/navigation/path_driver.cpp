// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/path_driver.hpp"

#include <algorithm>
#include <cmath>

#include "orca/geometry/arc.hpp"

namespace orca::nav {
namespace {

constexpr double kBackTime = 1.8;   // [s] of backing off, times the number of recoveries in a row,
constexpr int kMostRetreats = 5;    // up to this
constexpr double kMovedOn = 0.1;    // [m] or
constexpr double kTurnedOn = 0.3;   // [rad] that count as motion
constexpr double kIdle = 3.0;       // [s] without motion, though not blocked
constexpr double kRoomAhead = 1.5;  // [m]

}  // namespace

void PathDriver::begin(const Moment& moment) {
  stood_at_ = moment.pose;
  moved_at_ = moment.now;
}

Scene PathDriver::scene(const Moment& moment, const Pursuit& pursuit) const {
  const Pose2 soon = moment.pose * moved(moment.twist, pursuit.delay);
  return {soon, moment.twist.forward, points_, turning_};
}

std::optional<Steer> PathDriver::recover(const Moment& moment, const Pursuit& pursuit,
                                         const Retreat::Seen& seen) {
  if (!backs_off_since_) return std::nullopt;
  const Steer back = retreat_.step(moment.now, scene(moment, pursuit), seen);
  const double time = kBackTime * std::min(recoveries_, kMostRetreats);
  if (!back.blocked && to_seconds(moment.now - *backs_off_since_) < time) return back;
  backs_off_since_.reset();
  moved_at_ = moment.now;
  return std::nullopt;
}

void PathDriver::find_place(const Path& path, Vec2 robot) {
  along_ = path.nearest(robot, std::max(0.0, along_ - 0.3), std::min(along_ + 1.0, path.length()));
}

Steer PathDriver::follow_path(const Path& path, const Moment& moment, const Pursuit& pursuit,
                              double last_speed, double patience) {
  const Steer steer = follow(path, along_, scene(moment, pursuit), footprint_, pursuit, last_speed);
  watch(steer, moment, patience);
  return steer;
}

// Notes whether the robot gets on, and begins to recover if it does not.
void PathDriver::watch(const Steer& steer, const Moment& moment, double patience) {
  turning_ = steer.turning && !steer.blocked;
  const bool moves = norm(moment.pose.position() - stood_at_.position()) > kMovedOn ||
                     std::fabs(wrapped(moment.pose.yaw - stood_at_.yaw)) > kTurnedOn;
  if (moves) begin(moment);
  if (!steer.blocked) blocked_since_.reset();
  if (steer.blocked && !blocked_since_) blocked_since_ = moment.now;
  const bool stuck = (blocked_since_ && to_seconds(moment.now - *blocked_since_) > patience) ||
                     to_seconds(moment.now - moved_at_) > kIdle;
  if (!stuck) return;
  ++recoveries_;
  blocked_since_.reset();
  moved_at_ = moment.now;
  backs_off_since_ = moment.now;
  retreat_.begin();
}

void PathDriver::reset() {
  blocked_since_.reset();
  backs_off_since_.reset();
  retreat_.reset();
  turning_ = false;
  recoveries_ = 0;
}

double PathDriver::room_ahead(const Pose2& pose, double margin) const {
  return room_along(footprint_, pose, {kRoomAhead, 0.0, 0.0}, 30, points_, margin).share * kRoomAhead;
}

}  // namespace orca::nav
