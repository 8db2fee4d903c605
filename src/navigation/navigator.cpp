// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/navigator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/geometry/arc.hpp"

namespace orca::nav {
namespace {

constexpr double kBetter = 0.92;        // A new path must cost less than that share of the old one,
constexpr double kPlaceMoved = 0.05;    // [m] unless the errand has moved by that much.
constexpr double kWatchedPath = 2.0;    // [m] of the path that each scan is compared with
constexpr double kBlockedReplan = 0.2;  // [s] between two plans while blocked
constexpr double kBackTime = 1.8;       // [s] of backing off, times the number of recoveries in a row,
constexpr int kMostRetreats = 5;        // up to this
constexpr double kRemembered = 1.5;     // [m] around the robot that recovery does not forget
constexpr double kWay = 0.1;            // [m] or
constexpr double kTurn = 0.3;           // [rad] that count as motion
constexpr double kIdle = 3.0;           // [s] without motion, though not blocked
constexpr double kRoomAhead = 1.5;      // [m]
constexpr double kSameWay = 2.5;        // [m] ahead on which two paths are compared
constexpr double kBeside = 0.25;        // [m] apart: the same way
constexpr double kAside = 0.5;          // [m] off the path: plan again

}  // namespace

Navigator::Navigator(const Footprint& footprint, const NavigatorRules& rules)
    : footprint_(footprint), rules_(rules), retreat_(footprint), map_(rules.cell, rules.extent) {}

void Navigator::hear(std::span<const Beam> scan, const Pose2& pose) {
  const bool lost = !map_.lattice().holds(map_.lattice().cell_at(pose.position()));
  if (!std::exchange(begun_, true) || lost) map_.reset(pose.position());
  map_.follow(pose.position());
  map_.see(scan);
  const double reach = footprint_.outer_radius() + rules_.pursuit.max_look_ahead * 1.5 + 0.3;
  points_.clear();
  map_.for_points_near(pose.position(), reach, [this](Vec2 point) { points_.push_back(point); });
  // An echo counts at once, even where the map still believes that nothing is there.
  for (const Beam& beam : scan)
    if (beam.echo && norm(beam.to - pose.position()) < reach && !is_known(beam.to))
      points_.push_back(beam.to);
  news_ = true;
}

bool Navigator::is_known(Vec2 echo) const {
  const Cell cell = map_.lattice().cell_at(echo);
  return map_.lattice().holds(cell) && map_.occupied(cell);
}

void Navigator::drop_path() {
  plan_ = {};
  planned_for_.reset();
  blocked_since_.reset();
  backs_off_since_.reset();
  retreat_.reset();
  turning_ = false;
  recoveries_ = 0;
}

Scene Navigator::scene(const Moment& moment) const {
  const Pose2 soon = moment.pose * moved(moment.twist, rules_.pursuit.delay);
  return {soon, moment.twist.forward, points_, turning_};
}

std::optional<Vec2> Navigator::ahead(const Moment& moment) const {
  if (backs_off_since_ || plan_.path.empty()) return std::nullopt;
  const double look = look_ahead(moment.twist.forward, rules_.pursuit);
  return plan_.path.at(std::min(along_ + look, plan_.path.length()));
}

double Navigator::room_ahead(const Moment& moment) const {
  const Room room =
      room_along(footprint_, moment.pose, {kRoomAhead, 0.0, 0.0}, 30, points_, rules_.pursuit.margin);
  return room.share * kRoomAhead;
}

Steer Navigator::steer(const Moment& moment, const Errand& errand) {
  if (!planned_for_) {
    stood_at_ = moment.pose;
    moved_at_ = moment.now;
  }
  if (backs_off_since_) {
    const Steer back = retreat(moment);
    const double time = kBackTime * std::min(recoveries_, kMostRetreats);
    if (!back.blocked && to_seconds(moment.now - *backs_off_since_) < time) return back;
    backs_off_since_.reset();
    moved_at_ = moment.now;
  }
  retreat_.note(moment.pose);
  keep_path(moment, errand);
  news_ = false;
  const bool passes = errand.passing && plan_.complete;
  const Steer steer = follow(plan_.path, along_, scene(moment), footprint_, rules_.pursuit,
                             passes ? rules_.pursuit.max_speed : 0.0);
  return watch(steer, moment);
}

Steer Navigator::retreat(const Moment& moment) {
  return retreat_.step(moment.now, scene(moment), [this](Vec2 point) {
    const Cell cell = map_.lattice().cell_at(point);
    return map_.lattice().holds(cell) && map_.free(cell);
  });
}

void Navigator::keep_path(const Moment& moment, const Errand& errand) {
  if (!planned_for_ || plan_.path.empty() || norm(*planned_for_ - errand.place) > kPlaceMoved) {
    plan_ = {};
    return replan(moment, errand);
  }
  along_ = plan_.path.nearest(moment.pose.position(), std::max(0.0, along_ - 0.3),
                              std::min(along_ + 1.0, plan_.path.length()));
  const double age = to_seconds(moment.now - planned_at_);
  const bool due = age >= rules_.replan_every && news_;
  const bool aside = norm(plan_.path.at(along_) - moment.pose.position()) > kAside;
  const bool in_the_way =
      news_ && touches_along(map_, footprint_, plan_.path, along_ + 0.25, along_ + kWatchedPath) >= 0.0;
  if (due || ((aside || in_the_way || blocked_since_) && age >= kBlockedReplan)) replan(moment, errand);
}

void Navigator::replan(const Moment& moment, const Errand& errand) {
  planner_.look_at(map_, footprint_, rules_.wishes);
  Plan plan = planner_.plan(map_, moment.pose.position(), errand.place);
  planned_for_ = errand.place;
  planned_at_ = moment.now;
  const bool keeps = !plan_.path.empty() && plan_.complete && !blocked_since_ &&
                     norm(plan_.path.at(along_) - moment.pose.position()) < kAside &&
                     plan.cost > kBetter * planner_.cost_of(map_, plan_.path, along_) &&
                     !runs_beside(plan.path);
  if (keeps) return;
  plan_ = std::move(plan);
  along_ = 0.0;
}

// Returns whether a path from here goes the same way as the present one for some time: then it is only newer.
bool Navigator::runs_beside(const Path& path) const {
  for (double way = 0.0; way < kSameWay; way += kWay) {
    const Vec2 place = path.at(way);
    const double nearest =
        plan_.path.nearest(place, along_, std::min(along_ + way + 1.0, plan_.path.length()));
    if (norm(plan_.path.at(nearest) - place) > kBeside) return false;
  }
  return true;
}

// Notes whether the robot gets on, and begins to recover if it does not.
Steer Navigator::watch(const Steer& steer, const Moment& moment) {
  turning_ = steer.turning && !steer.blocked;
  const bool moves = norm(moment.pose.position() - stood_at_.position()) > kWay ||
                     std::fabs(wrapped(moment.pose.yaw - stood_at_.yaw)) > kTurn;
  if (moves) {
    stood_at_ = moment.pose;
    moved_at_ = moment.now;
  }
  if (!steer.blocked) blocked_since_.reset();
  if (steer.blocked && !blocked_since_) blocked_since_ = moment.now;
  const bool stuck = (blocked_since_ && to_seconds(moment.now - *blocked_since_) > rules_.patience) ||
                     to_seconds(moment.now - moved_at_) > kIdle;
  if (stuck) recover(moment);
  return steer;
}

void Navigator::recover(const Moment& moment) {
  ++recoveries_;
  blocked_since_.reset();
  moved_at_ = moment.now;
  backs_off_since_ = moment.now;
  retreat_.begin();
  plan_ = {};
  if (recoveries_ % 2 == 0) map_.forget_beyond(moment.pose.position(), kRemembered);
}

}  // namespace orca::nav
