// SPDX-License-Identifier: LGPL-3.0-or-later
#include "robot.hpp"

#include <bit>
#include <utility>

#include "arc.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kSampleDistance = 0.05;  // [m]
constexpr double kSampleTurn = 0.2;       // [rad]

}  // namespace

Robot::Robot(Birth birth, RobotModel robot_model, const ErrorLevels& errors)
    : name(std::move(birth.name)),
      model(std::move(robot_model)),
      drive(model.drive, errors, birth.tick),
      pose(birth.X_WB),
      tick_(birth.tick),
      odometry_model_(model.drive, errors, RandomStream(birth.seed, name, "odometry")),
      last_tick_{birth.time, birth.time, birth.X_WB, birth.X_WB},
      odometry_due_(model.odometer ? birth.time + model.odometer->period : kForever),
      trajectory_{{birth.time, birth.X_WB}} {
  const auto stream = [&](const std::string& device) { return RandomStream(birth.seed, name, device); };
  for (const SonarRing& s : model.sonars) sonars.emplace_back(s, errors, stream(s.name), birth.time);
  for (const LaserScanner& s : model.lasers) lasers.emplace_back(s, errors, stream(s.name), birth.time);
  for (const InfraredRing& s : model.infrareds) infrareds.emplace_back(s, errors, stream(s.name), birth.time);
  for (const BumperRing& s : model.bumpers) bumpers.emplace_back(s, birth.time);
}

void Robot::moved(const Pose2& X_WB, TimePoint now, bool blocked) {
  const double seconds = to_seconds(tick_);
  const double turn = wrapped(X_WB.yaw - pose.yaw);
  const Vec2 along = direction(pose.yaw + 0.5 * turn);
  const double travel = dot(X_WB.position() - pose.position(), along) / chord_ratio(turn);
  velocity = {travel / seconds, turn / seconds};
  if (blocked) drive.held_to(velocity);
  odometry_model_.add(travel, turn, seconds);
  odometry.reset();
  if (now >= odometry_due_) {
    odometry = odometry_model_.reading(now);
    odometry_due_ += model.odometer->period;
  }
  last_tick_ = {now - tick_, now, pose, X_WB};
  pose = X_WB;
  sample(now);
}

void Robot::chirp(SonarAir& air, std::size_t own_body) {
  for (SonarModel& s : sonars) s.fire(own_body, last_tick_, air);
}

void Robot::sense(const Caster& caster, const SonarAir& air, std::size_t own_body) {
  for (SonarModel& s : sonars) s.listen(caster, air);
  for (LaserModel& s : lasers) s.run(caster, own_body, last_tick_);
  for (InfraredModel& s : infrareds) s.run(caster, own_body, last_tick_);
}

void Robot::feel(std::span<const Touch> touches) {
  for (BumperModel& s : bumpers) s.run(touches, last_tick_.to);
}

void Robot::sample(TimePoint now) {
  const Pose2& last = trajectory_.back().pose;
  if (norm(pose.position() - last.position()) >= kSampleDistance ||
      std::fabs(wrapped(pose.yaw - last.yaw)) >= kSampleTurn)
    trajectory_.push_back({now, pose});
}

SceneRobot Robot::drawn() const {
  SceneRobot drawn{name, pose, placed(model.footprint, pose), trajectory_};
  if (!(drawn.trajectory.back().pose == pose)) drawn.trajectory.push_back({last_tick_.to, pose});
  return drawn;
}

void Robot::add_to(Fnv1a& hash) const {
  const Pose2 odometric = odometry_model_.reading({}).pose;
  for (const double value :
       {pose.x, pose.y, pose.yaw, velocity.forward, velocity.turn, odometric.x, odometric.y, odometric.yaw})
    hash.add_u64(std::bit_cast<std::uint64_t>(value));
}

}  // namespace orca::sim::detail
