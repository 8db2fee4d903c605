// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/navigator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/geometry/arc.hpp"

namespace orca::nav {
namespace {

constexpr double kPlaceMoved = 0.05;    // [m] unless the errand has moved by that much.
constexpr double kWatchedPath = 2.0;    // [m] of the path that each scan is compared with
constexpr double kBlockedReplan = 0.2;  // [s] between two plans while blocked
constexpr double kRemembered = 1.5;     // [m] around the robot that recovery does not forget

}  // namespace

Navigator::Navigator(const Footprint& footprint, const NavigatorRules& rules)
    : footprint_(footprint),
      rules_(rules),
      driver_(footprint, rules.recoveries),
      map_(rules.cell, rules.extent) {}

void Navigator::set_rules(const NavigatorRules& rules) {
  rules_ = rules;
  driver_.set_recoveries(rules.recoveries);
}

void Navigator::hear(std::span<const Beam> scan, const Pose2& pose) {
  if (!std::exchange(begun_, true) || !covers(pose.position())) map_.reset(pose.position());
  map_.follow(pose.position());
  map_.see(scan);
  if (doubts_) map_.clear_along(scan);
  const double reach = footprint_.outer_radius() + rules_.pursuit.max_look_ahead * 1.5 + 0.3;
  std::vector<Vec2>& points = driver_.points();
  points.clear();
  map_.for_points_near(pose.position(), reach, [&](Vec2 point) { points.push_back(point); });
  // An echo counts at once, even where the map still believes that nothing is there.
  for (const Beam& beam : scan)
    if (beam.echo && norm(beam.to - pose.position()) < reach && !is_known(beam.to)) points.push_back(beam.to);
  news_ = true;
}

bool Navigator::covers(Vec2 place) const { return map_.lattice().holds(map_.lattice().cell_at(place)); }

bool Navigator::is_known(Vec2 echo) const {
  const Cell cell = map_.lattice().cell_at(echo);
  return map_.lattice().holds(cell) && map_.occupied(cell);
}

void Navigator::drop_path() {
  kept_.drop();
  planned_for_.reset();
  driver_.reset();
}

std::optional<Vec2> Navigator::ahead(const Moment& moment) const {
  if (driver_.recovers() || path().empty()) return std::nullopt;
  const double look = look_ahead(moment.twist.forward, rules_.pursuit);
  return path().at(std::min(driver_.along() + look, path().length()));
}

double Navigator::room_ahead(const Moment& moment) const {
  return driver_.room_ahead(moment.pose, rules_.pursuit.margin);
}

bool Navigator::has_seen(Vec2 point) const {
  const Cell cell = map_.lattice().cell_at(point);
  return map_.lattice().holds(cell) && map_.known(map_.lattice().index(cell));
}

Steer Navigator::steer(const Moment& moment, const Errand& errand) {
  if (!covers(moment.pose.position())) {  // The pose has jumped: nothing is known there before the next scan.
    drop_path();
    return {};
  }
  if (!planned_for_) driver_.begin(moment);
  const auto seen = [this](Vec2 point) { return has_seen(point); };
  const auto recovered = driver_.recover(moment, rules_.pursuit, seen);
  if (doubts(driver_.recovery())) doubt(moment.pose.position());
  if (recovered) return *recovered;
  doubts_ = false;
  driver_.note(moment.pose);
  keep_path(moment, errand);
  news_ = false;
  const bool passes = errand.passing && kept_.plan().complete;
  const Steer steer =
      driver_.follow_path(path(), moment, rules_.pursuit,
                          {passes ? rules_.pursuit.max_speed : 0.0, rules_.patience, kept_.plan().complete});
  if (!driver_.recovers()) return steer;
  kept_.drop();
  return steer;
}

// Seen farther away it may be old.
void Navigator::doubt(Vec2 robot) {
  if (!doubts_) map_.forget_beyond(robot, kRemembered);
  doubts_ = true;
}

void Navigator::keep_path(const Moment& moment, const Errand& errand) {
  if (!planned_for_ || path().empty() || norm(*planned_for_ - errand.place) > kPlaceMoved) {
    kept_.drop();
    return replan(moment, errand);
  }
  driver_.find_place(path(), moment.pose.position());
  const double along = driver_.along();
  const double age = to_seconds(moment.now - planned_at_);
  const bool due = age >= rules_.replan_every && news_;
  const bool aside = norm(path().at(along) - moment.pose.position()) > KeptPlan::kAside;
  const bool in_the_way =
      news_ && touches_along(map_, footprint_, path(), along + 0.25, along + kWatchedPath) >= 0.0;
  if (due || ((aside || in_the_way || driver_.is_blocked()) && age >= kBlockedReplan)) replan(moment, errand);
}

void Navigator::replan(const Moment& moment, const Errand& errand) {
  planned_for_ = errand.place;
  planned_at_ = moment.now;
  const KeptPlan::Facts facts{map_,         footprint_,      rules_.wishes,       moment.pose.position(),
                              errand.place, driver_.along(), driver_.is_blocked()};
  if (kept_.renew(facts)) driver_.begin_path();
}

}  // namespace orca::nav
