// SPDX-License-Identifier: LGPL-3.0-or-later
#include "robot.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "orca/geometry/arc.hpp"

namespace orca::sim::detail {
namespace {

TickSpan still(TimePoint at, const Pose2& X_WB) { return {at, at, X_WB, X_WB, X_WB, X_WB}; }

}  // namespace

Robot::Robot(Birth birth, RobotModel robot_model, const ErrorLevels& errors)
    : name(std::move(birth.name)),
      model(std::move(robot_model)),
      drive(model.drive, errors, birth.tick),
      pose(birth.X_WB),
      body(birth.X_WB),
      sensors(model, name, errors, birth.seed, birth.time),
      carriers{still(birth.time, birth.X_WB), still(birth.time, birth.X_WB)},
      tick_(birth.tick),
      slip_(birth.seed, name, "wheels"),
      wheels_(model.drive, WheelErrors::drawn(model.drive.kind, errors, slip_)),
      odometry_due_(model.odometer ? birth.time + model.odometer->period : kForever) {
  if (model.turret) turret_.emplace(*model.turret);
  if (model.gripper) gripper.emplace(*model.gripper);
}

Travel2 Robot::set_off(const Floor& floor) {
  if (model.fixed) return {};
  driving_ = drive.step();
  return wheels_.over_ground(driving_ * to_seconds(tick_), steer_, footing(floor), slip_);
}

// A wheel that crossed a sill in the last tick pays for it in this one.
Footing Robot::footing(const Floor& floor) const {
  Footing footing{.slip = floor.slip_at(body.position())};
  if (floor.sills.empty()) return footing;
  const std::vector<Vec2> places = wheels_.places();
  for (std::size_t k = 0; k < places.size(); ++k)
    footing.lost[k] = floor.way_lost({carriers.body.X_from * places[k], carriers.body.X_to * places[k]},
                                     model.drive.wheel_diameter);
  return footing;
}

void Robot::moved(const Pose2& X_WB, TimePoint now, bool blocked) {
  const double seconds = to_seconds(tick_);
  if (steers()) steer_ = wrapped(steer_ + driving_.turn_rate * seconds);
  const Pose2 X_WR{X_WB.x, X_WB.y, steers() ? wrapped(X_WB.yaw + steer_) : X_WB.yaw};
  const Travel2 real = arc_between(pose, X_WR);
  velocity = real / seconds;
  Travel2 rolled = driving_ * seconds;
  if (blocked && !model.fixed) {
    rolled = wheels_.rolled(real);
    if (steers()) rolled.turn = driving_.turn_rate * seconds;  // An obstacle does not hold the steering.
    drive.held_to(rolled / seconds);
  }
  reckon(rolled, now);
  carry(X_WB, X_WR, now);
  if (trail_) trail_->add({now, pose});
}

void Robot::put(const Pose2& X_WB, TimePoint now) {
  body = X_WB;
  pose = {X_WB.x, X_WB.y, steers() ? wrapped(X_WB.yaw + steer_) : X_WB.yaw};
  velocity = {};
  drive.held_to({});
  carriers.body = {now, now, body, body, pose, pose};
  carriers.turret = carriers.body;
  if (turret_) carriers.turret.X_from = carriers.turret.X_to = turret_pose(X_WB);
  if (trail_) trail_->add({now, pose});
}

void Robot::reckon(const Travel2& rolled, TimePoint now) {
  odometry_model_.add(rolled, to_seconds(tick_));
  odometry.reset();
  if (now < odometry_due_) return;
  odometry = odometry_model_.reading(now);
  odometry_due_ += model.odometer->period;
}

void Robot::carry(const Pose2& X_WB, const Pose2& X_WR, TimePoint now) {
  carriers.body = {now - tick_, now, body, X_WB, pose, X_WR};
  if (turret_) {
    const Pose2 before = turret_pose(body);
    const double turn = wrapped(X_WR.yaw - X_WB.yaw - (pose.yaw - body.yaw));
    turret_->step(wrapped(X_WR.yaw - X_WB.yaw) + drive.turret_angle(), turn / to_seconds(tick_),
                  to_seconds(tick_));
    carriers.turret = {now - tick_, now, before, turret_pose(X_WB), pose, X_WR};
  }
  pose = X_WR;
  body = X_WB;
}

// Returns the pose of the base frame, turned by the turret about its axis.
Pose2 Robot::turret_pose(const Pose2& X_WB) const {
  const Vec2 axis = turret_->axis();
  const Vec2 back = rotated(-1.0 * axis, turret_->angle());
  return X_WB * Pose2{axis.x + back.x, axis.y + back.y, turret_->angle()};
}

std::optional<TurretReading> Robot::turret() const {
  if (!turret_) return std::nullopt;
  const double steering = steers() ? driving_.turn_rate : 0.0;
  return TurretReading{carriers.body.to, wrapped(turret_->angle() - wrapped(pose.yaw - body.yaw)),
                       turret_->rate() - steering};
}

RobotSnapshot Robot::drawn() const {
  RobotSnapshot drawn{name, pose, placed(model.footprint, body), {}};
  if (!trail_) return drawn;
  drawn.trajectory = trail_->samples();
  if (!(drawn.trajectory.back().pose == pose)) drawn.trajectory.push_back({carriers.body.to, pose});
  return drawn;
}

void Robot::add_to(Fnv1a& hash) const {
  const Pose2 odometric = odometry_model_.reading({}).pose;
  for (const double value :
       {pose.x, pose.y, pose.yaw, body.yaw, turret_ ? turret_->angle() : 0.0, velocity.forward, velocity.left,
        velocity.turn_rate, odometric.x, odometric.y, odometric.yaw})
    hash.add_u64(std::bit_cast<std::uint64_t>(value));
  if (gripper) gripper->add_to(hash);
}

const Robot* robot_at(const std::deque<Robot>& robots, const Body& body) {
  const auto found = std::ranges::find_if(robots, [&](const Robot& r) {
    return body.top > r.model.bottom && overlap(body.shape, placed(r.model.footprint, r.body));
  });
  return found == robots.end() ? nullptr : &*found;
}

void Trail::add(const RobotSnapshot::Sample& now) {
  const Pose2& last = samples_.back().pose;
  if (norm(now.pose.position() - last.position()) < way_ &&
      std::fabs(wrapped(now.pose.yaw - last.yaw)) < turn_)
    return;
  if (samples_.size() == kMost) thin_out();
  samples_.push_back(now);
}

// Keeps every second pose, the first among them. A step of a whole turn is never reached, so that later only way counts.
void Trail::thin_out() {
  for (std::size_t i = 1; 2 * i < samples_.size(); ++i) samples_[i] = samples_[2 * i];
  samples_.resize((samples_.size() + 1) / 2);
  way_ *= 2.0;
  turn_ *= 2.0;
}

}  // namespace orca::sim::detail
