// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/path_driver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/geometry/arc.hpp"

namespace orca::nav {
namespace {

constexpr double kBackTime = 1.8;        // [s] of backing off, times the number of retreats in a row,
constexpr int kMostRetreats = 5;         // up to this
constexpr double kClearTime = 0.3;       // [s] until a scan has come
constexpr double kWaitTime = 4.0;        // [s]
constexpr double kLookPatience = 1.0;    // [s] and the time that its turn so far takes
constexpr double kLeastPace = 0.15;      // [rad/s] at this rate: it ends where something holds the robot
constexpr double kLookAngle = 0.8;       // [rad] ahead for which its corners must find room
constexpr double kMovedOn = 0.1;         // [m] or
constexpr double kTurnedOn = 0.3;        // [rad] that count as motion
constexpr double kIdle = 3.0;            // [s] without motion, though not blocked
constexpr double kLeft = 0.5;            // [m] from a place: it has left it
constexpr double kRoaming = 8.0;         // [s] near one place; turning round takes less
constexpr double kRoamingNowhere = 3.0;  // [s] likewise, if no way leads to the goal
constexpr double kRoomAhead = 1.5;       // [m]

}  // namespace

void PathDriver::begin(const Moment& moment) {
  stood_at_ = moment.pose;
  moved_at_ = moment.now;
  left_ = moment.pose.position();
  left_at_ = moment.now;
}

Scene PathDriver::scene(const Moment& moment, const Pursuit& pursuit) const {
  const Pose2 soon = moment.pose * moved(moment.twist, pursuit.delay);
  return {soon, moment.twist.forward, points_, turning_};
}

std::optional<Steer> PathDriver::recover(const Moment& moment, const Pursuit& pursuit,
                                         const Retreat::Seen& seen) {
  if (!recovers()) return std::nullopt;
  for (std::size_t i = 0; i <= order_.size(); ++i) {
    if (const auto steer = go_on(moment, pursuit, seen)) {
      acts_ = true;
      return steer;
    }
    if (acts_ || order_.empty()) break;
    begin_recovery(moment);  // It could do nothing.
  }
  recovers_since_.reset();
  begin(moment);
  return std::nullopt;
}

// Returns the next moment of the recovery; nothing if it is over.
std::optional<Steer> PathDriver::go_on(const Moment& moment, const Pursuit& pursuit,
                                       const Retreat::Seen& seen) {
  const double time = to_seconds(moment.now - *recovers_since_);
  switch (recovery_) {
    case Recovery::back_off: {
      const Steer back = retreat_.step(moment.now, scene(moment, pursuit), seen);
      const bool goes_on = !back.blocked && time < kBackTime * std::min(retreats_, kMostRetreats);
      return goes_on ? std::optional(back) : std::nullopt;
    }
    case Recovery::look_around:
      return time < kLookPatience + turned_ / kLeastPace ? look_around(moment, pursuit) : std::nullopt;
    case Recovery::clear: return time < kClearTime ? std::optional(Steer{}) : std::nullopt;
    case Recovery::wait: return time < kWaitTime ? std::optional(Steer{}) : std::nullopt;
  }
  return std::nullopt;
}

std::optional<Steer> PathDriver::look_around(const Moment& moment, const Pursuit& pursuit) {
  turned_ += std::fabs(wrapped(moment.pose.yaw - faced_));
  faced_ = moment.pose.yaw;
  const double left = 2.0 * std::numbers::pi - turned_;
  if (left < pursuit.turned) return std::nullopt;
  const Steer steer =
      turn_on_the_spot(std::min(left, kLookAngle), scene(moment, pursuit), footprint_, pursuit);
  return steer.blocked ? std::nullopt : std::optional(steer);
}

void PathDriver::find_place(const Path& path, Vec2 robot) {
  along_ = path.nearest(robot, std::max(0.0, along_ - 0.3), std::min(along_ + 1.0, path.length()));
}

Steer PathDriver::follow_path(const Path& path, const Moment& moment, const Pursuit& pursuit,
                              const Manner& manner) {
  const Steer steer = follow(path, along_, scene(moment, pursuit), footprint_, pursuit, manner.last_speed);
  watch(steer, moment, manner, pursuit.max_speed);
  return steer;
}

// Notes whether the robot gets on, and begins to recover if it does not.
void PathDriver::watch(const Steer& steer, const Moment& moment, const Manner& manner, double speed) {
  turning_ = steer.turning && !steer.blocked;
  note_motion(moment);
  if (!steer.blocked) blocked_since_.reset();
  if (steer.blocked && !blocked_since_) blocked_since_ = moment.now;
  // A slow robot takes twice the time that it needs.
  const double roaming =
      std::max(manner.leads_there ? kRoaming : kRoamingNowhere, 2.0 * kLeft / std::max(speed, 0.01));
  const bool stuck = (blocked_since_ && to_seconds(moment.now - *blocked_since_) > manner.patience) ||
                     to_seconds(moment.now - moved_at_) > kIdle ||
                     to_seconds(moment.now - left_at_) > roaming;
  if (stuck && !order_.empty()) begin_recovery(moment);
}

void PathDriver::note_motion(const Moment& moment) {
  if (norm(moment.pose.position() - stood_at_.position()) > kMovedOn ||
      std::fabs(wrapped(moment.pose.yaw - stood_at_.yaw)) > kTurnedOn) {
    stood_at_ = moment.pose;
    moved_at_ = moment.now;
  }
  if (norm(moment.pose.position() - left_) <= kLeft) return;
  left_ = moment.pose.position();
  left_at_ = moment.now;
}

void PathDriver::begin_recovery(const Moment& moment) {
  recovery_ = order_[static_cast<std::size_t>(recoveries_) % order_.size()];
  ++recoveries_;
  blocked_since_.reset();
  recovers_since_ = moment.now;
  acts_ = false;
  turned_ = 0.0;
  faced_ = moment.pose.yaw;
  if (recovery_ != Recovery::back_off) return;
  ++retreats_;
  retreat_.begin();
}

void PathDriver::reset() {
  blocked_since_.reset();
  recovers_since_.reset();
  retreat_.reset();
  turning_ = false;
  recoveries_ = retreats_ = 0;
}

double PathDriver::room_ahead(const Pose2& pose, double margin) const {
  return room_along(footprint_, pose, {kRoomAhead, 0.0, 0.0}, 30, points_, margin).share * kRoomAhead;
}

}  // namespace orca::nav
