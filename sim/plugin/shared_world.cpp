// SPDX-License-Identifier: LGPL-3.0-or-later
#include "shared_world.hpp"

#include <map>
#include <utility>

namespace orca::sim {
namespace {

constexpr Duration kFarBehind = std::chrono::milliseconds(200);
constexpr Duration kMotionPeriod = std::chrono::milliseconds(100);

template <class Reading>
void shift(Reading& reading, Duration by) {
  reading.stamp += by;
}
void shift(SonarScan& scan, Duration by) {
  for (SonarReading& reading : scan.readings) reading.stamp += by;
}

// Puts a reading, if there is one, into the inbox with its stamp moved.
template <class Reading>
void take(const std::optional<Reading>& reading, std::size_t device, Duration by,
          SharedWorld::Inbox::Readings<Reading>& box) {
  if (!reading) return;
  box.emplace_back(device, *reading);
  shift(box.back().second, by);
}

}  // namespace

Result<std::shared_ptr<SharedWorld>> SharedWorld::join(const std::string& key, const std::string& settings,
                                                       TimePoint now, const std::function<World()>& make) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<SharedWorld>> worlds;
  const std::lock_guard lock(mutex);
  std::shared_ptr<SharedWorld> world = worlds[key].lock();
  if (world != nullptr && world->settings_ != settings)
    return fail(Code::failed_precondition, "another robot has this world with " + world->settings_ +
                                               ", and this one wants " + settings +
                                               "; robots that share a world need the same");
  if (world == nullptr) {
    world = std::make_shared<SharedWorld>(make(), settings, now);
    worlds[key] = world;
  }
  return world;
}

Result<RobotId> SharedWorld::add_robot(const std::string& name, const RobotModel& model, const Pose2& X_WB,
                                       Duration truth_period) {
  const std::lock_guard lock(mutex_);
  const Result<RobotId> robot = world_.add_robot(name, model, X_WB);
  const TimePoint next_turret = model.turret ? world_.time() + model.turret->period : kForever;
  const TimePoint next_gripper = model.gripper ? world_.time() + model.gripper->period : kForever;
  const TimePoint next_battery = model.battery ? world_.time() + model.battery->period : kForever;
  const TimePoint now = world_.time();
  if (robot)
    members_.push_back(
        {*robot, name, truth_period, now + truth_period, next_turret, next_gripper, next_battery, now, {}});
  return robot;
}

const SharedWorld::Member& SharedWorld::member(RobotId robot) const {
  return members_.at(static_cast<std::size_t>(robot));
}

SharedWorld::Member& SharedWorld::member(RobotId robot) {
  return members_.at(static_cast<std::size_t>(robot));
}

Status SharedWorld::command(RobotId robot, const hw::DriveSetpoint& setpoint, TimePoint now) {
  const std::lock_guard lock(mutex_);
  catch_up(now);
  if (setpoint.at_once) {
    world_.emergency_stop(robot);
    return ok();
  }
  return world_.set_velocity_command(robot, setpoint.velocity);
}

Status SharedWorld::point_turret(RobotId robot, double angle, TimePoint now) {
  const std::lock_guard lock(mutex_);
  catch_up(now);
  return world_.set_turret_command(robot, angle);
}

Status SharedWorld::move_gripper(RobotId robot, const GripperOrder& order, TimePoint now) {
  const std::lock_guard lock(mutex_);
  catch_up(now);
  return world_.set_gripper_command(robot, order);
}

SharedWorld::Inbox SharedWorld::advance(RobotId robot, TimePoint now) {
  const std::lock_guard lock(mutex_);
  catch_up(now);
  Member& polling = member(robot);
  polling.seen = world_.time();
  return std::exchange(polling.inbox, {});
}

void SharedWorld::catch_up(TimePoint now) {
  const Duration behind = now - on_run_clock(world_.time());
  if (behind > kFarBehind) {
    epoch_ += behind - World::kTick;
    if (!members_.empty()) members_.front().inbox.lost += behind - World::kTick;
  }
  while (on_run_clock(world_.time() + World::kTick) <= now) step();
}

void SharedWorld::step() {
  world_.step();
  for (const std::string& event : world_.happened()) members_.front().inbox.happened.push_back(event);
  for (Member& member : members_) collect(member);
  collect_events();
}

void SharedWorld::collect_events() {
  const TimePoint now = on_run_clock(world_.time());
  for (const std::string& text : world_.happened()) events_.push_back({now, text});
  for (const ContactEvent& contact : world_.contacts())
    events_.push_back({now, contact.robot + " touches " + contact.other,
                       world_.pose(*world_.find(contact.robot)).position()});
  while (!events_.empty() && events_.front().time < now - kEventsKept) events_.pop_front();
}

std::vector<SharedWorld::Event> SharedWorld::events() const {
  const std::lock_guard lock(mutex_);
  return {events_.begin(), events_.end()};
}

void SharedWorld::note(std::string text, TimePoint now) {
  const std::lock_guard lock(mutex_);
  events_.push_back({now, std::move(text)});
}

void SharedWorld::collect_readings(Member& member) {
  const RobotId robot = member.robot;
  const RobotModel& model = world_.robot_model(robot);
  Inbox& inbox = member.inbox;
  for (std::size_t i = 0; i < model.sonars.size(); ++i) take(world_.sonar(robot, i), i, epoch_, inbox.sonar);
  for (std::size_t i = 0; i < model.lasers.size(); ++i) take(world_.laser(robot, i), i, epoch_, inbox.laser);
  for (std::size_t i = 0; i < model.infrareds.size(); ++i)
    take(world_.infrared(robot, i), i, epoch_, inbox.infrared);
  for (std::size_t i = 0; i < model.bumpers.size(); ++i)
    take(world_.bumper(robot, i), i, epoch_, inbox.bumper);
  for (std::size_t i = 0; i < model.cameras.size(); ++i)
    take(picture_in(world_, robot, i), i, epoch_, inbox.camera);
}

void SharedWorld::collect_turret(Member& member) {
  if (world_.time() < member.next_turret) return;
  member.next_turret += world_.robot_model(member.robot).turret->period;
  member.inbox.turret.push_back(world_.turret(member.robot).value());
  member.inbox.turret.back().stamp = on_run_clock(world_.time());
}

void SharedWorld::collect_gripper(Member& member) {
  if (world_.time() < member.next_gripper) return;
  member.next_gripper += world_.robot_model(member.robot).gripper->period;
  member.inbox.gripper.push_back(world_.gripper(member.robot).value());
  member.inbox.gripper.back().stamp = on_run_clock(world_.time());
}

void SharedWorld::collect_battery(Member& member) {
  if (world_.time() < member.next_battery) return;
  member.next_battery += world_.robot_model(member.robot).battery->period;
  member.inbox.battery.push_back(battery_in(world_, member.robot).value());
  member.inbox.battery.back().stamp = on_run_clock(world_.time());
}

void SharedWorld::collect_motion(Member& member) {
  if (!member.next_step || world_.time() < *member.next_step) return;
  *member.next_step += kMotionPeriod;
  member.motion.push_back({on_run_clock(world_.time()), world_.pose(member.robot),
                           world_.velocity(member.robot), world_.clearance(member.robot, Scene::kFar)});
}

void SharedWorld::collect_encounters(Member& member) {
  if (!member.next_step) return;
  const RobotId robot = member.robot;
  const Shape outline = placed(world_.robot_model(robot).footprint, world_.body_pose(robot));
  const Twist2 velocity = world_.velocity(robot);
  const Encounters::Now now{on_run_clock(world_.time()), outline, norm({velocity.forward, velocity.left})};
  for (const Person& person : people_in(world_)) member.encounters.look(person, now);
  for (const ContactEvent& contact : world_.contacts())
    if (contact.robot == member.name && contact.person_speed) member.encounters.touch(contact, now.time);
}

void SharedWorld::collect(Member& member) {
  collect_readings(member);
  collect_turret(member);
  collect_gripper(member);
  collect_battery(member);
  collect_motion(member);
  collect_encounters(member);
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

TimePoint SharedWorld::next_tick(RobotId robot) const {
  const std::lock_guard lock(mutex_);
  return on_run_clock(member(robot).seen + World::kTick);
}

void SharedWorld::keep_trajectory(RobotId robot) {
  const std::lock_guard lock(mutex_);
  world_.keep_trajectory(robot);
}

void SharedWorld::keep_motion(RobotId robot) {
  const std::lock_guard lock(mutex_);
  member(robot).next_step = world_.time();
}

std::vector<Scene::Step> SharedWorld::motion(RobotId robot) const {
  const std::lock_guard lock(mutex_);
  return member(robot).motion;
}

std::vector<Scene::Encounter> SharedWorld::encounters(RobotId robot) const {
  const std::lock_guard lock(mutex_);
  return member(robot).encounters.all();
}

std::size_t SharedWorld::people() const {
  const std::lock_guard lock(mutex_);
  return people_in(world_).size();
}

Snapshot SharedWorld::snapshot() const {
  const std::lock_guard lock(mutex_);
  return world_.snapshot();
}

}  // namespace orca::sim
