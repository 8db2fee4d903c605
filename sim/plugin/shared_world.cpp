// SPDX-License-Identifier: LGPL-3.0-or-later
#include "shared_world.hpp"

#include <map>
#include <utility>

namespace orca::sim {
namespace {

constexpr Duration kFarBehind = std::chrono::milliseconds(200);

}  // namespace

std::shared_ptr<SharedWorld> SharedWorld::join(const std::string& key, TimePoint now,
                                               const std::function<World()>& make) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<SharedWorld>> worlds;
  const std::lock_guard lock(mutex);
  std::shared_ptr<SharedWorld> world = worlds[key].lock();
  if (world == nullptr) {
    world = std::make_shared<SharedWorld>(make(), now);
    worlds[key] = world;
  }
  return world;
}

Result<RobotId> SharedWorld::add_robot(const std::string& name, const RobotModel& model, const Pose2& X_WB,
                                       Duration truth_period) {
  const std::lock_guard lock(mutex_);
  const Result<RobotId> robot = world_.add_robot(name, model, X_WB);
  if (robot) members_.push_back({*robot, name, truth_period, world_.time() + truth_period, {}});
  return robot;
}

Status SharedWorld::command(RobotId robot, double forward, double turn) {
  const std::lock_guard lock(mutex_);
  return world_.set_velocity_command(robot, forward, turn);
}

SharedWorld::Inbox SharedWorld::advance(RobotId robot, TimePoint now) {
  const std::lock_guard lock(mutex_);
  const Duration behind = now - on_run_clock(world_.time());
  if (behind > kFarBehind) epoch_ += behind - World::kTick;
  while (on_run_clock(world_.time() + World::kTick) <= now) step();
  for (Member& member : members_)
    if (member.robot == robot) return std::exchange(member.inbox, {});
  return {};
}

void SharedWorld::step() {
  world_.step();
  for (Member& member : members_) collect(member);
}

void SharedWorld::collect(Member& member) {
  const std::size_t rings = world_.robot_model(member.robot).sonars.size();
  for (std::size_t ring = 0; ring < rings; ++ring) {
    if (const auto& scan = world_.sonar(member.robot, ring)) {
      member.inbox.sonar.emplace_back(ring, *scan);
      for (SonarReading& reading : member.inbox.sonar.back().second.readings)
        reading.stamp = on_run_clock(reading.stamp);
    }
  }
  if (const auto& odometry = world_.odometry(member.robot)) {
    member.inbox.odometry.push_back(*odometry);
    member.inbox.odometry.back().stamp = on_run_clock(odometry->stamp);
  }
  if (world_.time() >= member.next_truth) {
    member.next_truth += member.truth_period;
    member.inbox.truth.push_back(
        {on_run_clock(world_.time()), world_.pose(member.robot), world_.velocity(member.robot)});
  }
  for (const ContactEvent& contact : world_.contacts()) {
    if (contact.robot != member.name) continue;
    member.inbox.contacts.push_back({contact, world_.pose(member.robot)});
    member.inbox.contacts.back().event.time = on_run_clock(contact.time);
  }
}

TimePoint SharedWorld::next_tick() const {
  const std::lock_guard lock(mutex_);
  return on_run_clock(world_.time() + World::kTick);
}

Scene SharedWorld::scene() const {
  const std::lock_guard lock(mutex_);
  return world_.scene();
}

}  // namespace orca::sim
