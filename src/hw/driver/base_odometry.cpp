// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/base_odometry.hpp"

#include "orca/geometry/angle.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/idl/time.hpp"

namespace orca::hw {

int CountedPose::step(int from, int to) const {
  const int forward = (to - from) & (turn_ - 1);
  return forward < turn_ / 2 ? forward : forward - turn_;
}

void CountedPose::take(int x, int y, double unit, double heading) {
  if (!last_) offset_ = wrapped(pose_.yaw - heading);
  const Counts before = last_.value_or(Counts{x, y});
  last_ = {x, y};
  const Vec2 way = rotated(Vec2{unit * step(before.x, x), unit * step(before.y, y)}, offset_);
  pose_ = {pose_.x + way.x, pose_.y + way.y, wrapped(heading + offset_)};
}

void BaseOdometry::publish(const Pose2& pose, const Twist2& velocity, TimePoint stamp) {
  const Pose2 here = calibration_ == Calibration{} ? pose : calibrated(pose);
  const Twist2 real = calibration_.to_base(velocity);
  auto object = endpoint_.loan();
  object->x(here.x);
  object->y(here.y);
  object->steer_angle(here.yaw);
  object->translational_velocity(real.forward);
  object->sideways_velocity(real.left);
  object->steering_velocity(real.turn_rate);
  if (uncertainty_) {
    uncertainty_->move_to(here);
    object->covariance(uncertainty_->covariance());
  }
  object->stamp(to_time_value(stamp));
  endpoint_.publish(std::move(object));
}

// The chord of a step lies half its turn beside the direction at its beginning.
Pose2 BaseOdometry::calibrated(const Pose2& counted) {
  const Pose2 step = seen_from(counted_, counted);
  counted_ = counted;
  const double forward = arc_between(Pose2{}, step).forward;
  const double more_turn = (calibration_.turn - 1.0) * step.yaw + calibration_.turn_per_metre * forward;
  const Vec2 chord = calibration_.distance * rotated(Vec2{step.x, step.y}, 0.5 * more_turn);
  pose_ = pose_ * Pose2{chord.x, chord.y, wrapped(step.yaw + more_turn)};
  return pose_;
}

}  // namespace orca::hw
