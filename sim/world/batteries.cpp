// SPDX-License-Identifier: LGPL-3.0-or-later
#include "batteries.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace orca::sim::detail {
namespace {

constexpr double kAtRest = 0.005;  // [m/s]
constexpr double kDocking = 0.1;   // [m/s] at most, of a robot that docks
// Factor on what it may be off: what is around the contacts is made to be touched.
constexpr double kDockSlack = 4.0;

// @param slack  factor on what a robot may be off.
bool reaches(const Robot& robot, const Charger& charger, double slack = 1.0) {
  const double front = charger.at_front ? bounds_of(robot.model.footprint).high.x : 0.0;
  const double askew = std::fabs(wrapped(robot.body.yaw - charger.pose.yaw));
  return norm(robot.body * Vec2{front, 0.0} - charger.pose.position()) <= slack * charger.reach &&
         (!charger.at_front || askew <= slack * Charger::kAskew);
}

}  // namespace

void Batteries::add() {
  const RobotModel& model = robots_.back().model;
  if (model.battery) batteries_.emplace(robots_.size() - 1, *model.battery);
}

bool Batteries::is_charged(const Robot& robot) const {
  return robot.speed() < kAtRest && std::ranges::any_of(world_.chargers, [&](const Charger& charger) {
           return reaches(robot, charger);
         });
}

bool Batteries::docks(const Robot& robot) const {
  return robot.speed() <= kDocking && std::ranges::any_of(world_.chargers, [&](const Charger& charger) {
           return charger.at_front && reaches(robot, charger, kDockSlack);
         });
}

void Batteries::work(Duration tick) {
  for (auto& [number, battery] : batteries_) {
    Robot& robot = robots_[number];
    battery.step(to_seconds(tick), std::min(robot.speed() / robot.model.drive.max_speed, 1.0),
                 is_charged(robot));
    if (battery.is_empty()) robot.drive.command({});
  }
}

const BatteryModel* Batteries::of(std::size_t robot) const {
  const auto found = batteries_.find(robot);
  return found == batteries_.end() ? nullptr : &found->second;
}

BatteryModel* Batteries::of(std::size_t robot) {
  const auto found = batteries_.find(robot);
  return found == batteries_.end() ? nullptr : &found->second;
}

void Batteries::add_to(Fnv1a& hash) const {
  for (const auto& [number, battery] : batteries_)
    hash.add_u64(std::bit_cast<std::uint64_t>(battery.charge()));
}

}  // namespace orca::sim::detail
