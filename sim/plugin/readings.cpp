// SPDX-License-Identifier: LGPL-3.0-or-later
#include "objects.hpp"

#include <limits>

#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace orca::sim {

void fill(idl::SonarRangeReadings& object, const SonarScan& scan, const SonarRing& ring) {
  object.ranges().clear();
  object.poses().clear();
  object.stamps().clear();
  for (const SonarReading& reading : scan.readings) {
    object.ranges().push_back(reading.range);
    object.poses().push_back(level_frame(reading.sensor, ring.height_of(reading.transducer)));
    object.stamps().push_back(to_time_value(reading.stamp));
  }
  object.min_range(ring.min_range);
  object.max_range(ring.max_range);
  object.half_lobe(ring.half_lobe);
  object.pose(level_pose(scan.X_RB * ring.center, ring.height, scan.stamp));
}

void fill(idl::LaserRangeReadings& object, const LaserScan& scan, const LaserScanner& laser) {
  object.ranges().assign(scan.ranges.begin(), scan.ranges.end());
  for (std::size_t k = 0; k < scan.ranges.size(); ++k)
    if (laser.ignores(laser.first_angle + static_cast<double>(k) * laser.pitch))
      object.ranges()[k] = std::numeric_limits<double>::quiet_NaN();
  object.min_range(laser.min_range);
  object.max_range(laser.max_range);
  object.pose(level_pose(scan.X_RB * laser.center, laser.height, scan.stamp));
  object.stamp(to_time_value(scan.stamp));
  object.angle_start(laser.first_angle);
  object.angle_increment(laser.pitch);
  object.time_increment(laser.count < 2 ? 0.0
                                        : to_seconds(laser.sweep) / static_cast<double>(laser.count - 1));
}

void fill(idl::InfraredRangeReadings& object, const InfraredScan& scan, const InfraredRing& ring) {
  object.ranges().assign(scan.ranges.begin(), scan.ranges.end());
  object.poses().clear();
  for (std::size_t k = 0; k < ring.count; ++k)
    object.poses().push_back(level_frame(scan.X_RB * ring.sensor(k), ring.height));
  object.stamps().assign(ring.count, to_time_value(scan.stamp));
  object.min_range(ring.min_range);
  object.max_range(ring.max_range);
  object.half_beam(ring.half_beam);
  object.pose(level_pose(scan.X_RB * ring.center, ring.height, scan.stamp));
}

void fill(idl::BumperReadings& object, const BumperReading& reading, const BumperRing& ring) {
  object.pressed().assign(reading.pressed.begin(), reading.pressed.end());
  object.poses().clear();
  for (std::size_t k = 0; k < ring.count; ++k)
    object.poses().push_back(level_frame(reading.X_RB * ring.segment(k), 0.0));
  object.stamp(to_time_value(reading.stamp));
}

void fill(idl::Odometry& object, const OdometryReading& reading, const std::array<double, 9>& covariance) {
  object.x(reading.pose.x);
  object.y(reading.pose.y);
  object.steer_angle(reading.pose.yaw);
  object.translational_velocity(reading.velocity.forward);
  object.sideways_velocity(reading.velocity.left);
  object.steering_velocity(reading.velocity.turn_rate);
  object.stamp(to_time_value(reading.stamp));
  object.covariance(covariance);
}

void fill(idl::TurretAngle& object, const TurretReading& reading) {
  object.angle(reading.angle);
  object.turn_rate(reading.turn_rate);
  object.stamp(to_time_value(reading.stamp));
}

void fill(idl::GripperState& object, const GripperReading& reading) {
  object.open(reading.is_open);
  object.closed(reading.is_closed);
  object.paddles_move(reading.paddles_move);
  object.up(reading.lift == 1.0);
  object.down(reading.lift == 0.0);
  object.lift_moves(reading.lift_moves);
  object.inner_beam(reading.inner_beam);
  object.outer_beam(reading.outer_beam);
  object.holds(reading.holds);
  object.stamp(to_time_value(reading.stamp));
}

void fill(idl::Battery& object, const BatteryReading& reading) {
  object.name("drive");
  object.voltage(reading.voltage);
  object.current(std::nan(""));
  object.charge(reading.charge);
  object.charging(reading.charging);
  object.temperature(std::nan(""));
  object.stamp(to_time_value(reading.stamp));
}

void fill(idl::RobotPose& object, const SharedWorld::Inbox::Truth& truth) {
  object.x(truth.pose.x);
  object.y(truth.pose.y);
  object.orientation(truth.pose.yaw);
  object.translational_velocity(truth.velocity.forward);
  object.sideways_velocity(truth.velocity.left);
  object.steering_velocity(truth.velocity.turn_rate);
  object.stamp(to_time_value(truth.stamp));
}

SharedWorld::Inbox in_world(SharedWorld::Inbox inbox, const Pose2& X_WF) {
  const auto move = [&X_WF](auto& readings) {
    for (auto& [number, reading] : readings) reading.X_RB = X_WF * reading.X_RB;
  };
  move(inbox.sonar);
  move(inbox.laser);
  move(inbox.infrared);
  move(inbox.bumper);
  move(inbox.camera);
  for (auto& [ring, scan] : inbox.sonar)
    for (SonarReading& reading : scan.readings) reading.sensor = X_WF * reading.sensor;
  return inbox;
}

}  // namespace orca::sim
