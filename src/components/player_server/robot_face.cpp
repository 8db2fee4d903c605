// SPDX-License-Identifier: LGPL-3.0-or-later
#include "robot_face.hpp"

#include <algorithm>

#include "orca/geometry/objects/plane.hpp"

namespace orca::player_server {
namespace {

// Player has no word for "no echo" but the longest range.
std::vector<float> shown(const std::vector<double>& ranges, double longest) {
  std::vector<float> all;
  all.reserve(ranges.size());
  for (const double range : ranges) all.push_back(static_cast<float>(std::min(range, longest)));
  return all;
}

}  // namespace

std::vector<DeviceName> RobotFace::devices() const {
  std::vector<DeviceName> all{kBase};
  if (has_sonar) all.insert(all.end(), {kSonar, kSonarRanger});
  if (has_laser) all.insert(all.end(), {kLaser, kLaserRanger});
  return all;
}

// Sonars are elements of a device in the robot's middle, and a laser is a device of one element.
hw::player::RangerGeometry RobotFace::ranger_geometry(const DeviceName& ranger) const {
  if (ranger == kLaserRanger)
    return {
        .pose = laser_pose, .element_poses = {hw::player::Pose3{}}, .element_sizes = {hw::player::Size3{}}};
  return {.element_poses = sonar_poses.poses,
          .element_sizes = std::vector<hw::player::Size3>(sonar_poses.poses.size())};
}

hw::player::RangerConfig RobotFace::ranger_config(const DeviceName& ranger) const {
  if (ranger == kLaserRanger)
    return {.min_angle = laser_config.min_angle,
            .max_angle = laser_config.max_angle,
            .angular_resolution = laser_config.resolution,
            .max_range = laser_config.max_range};
  return {.min_angle = -0.5 * sonar_lobe,
          .max_angle = 0.5 * sonar_lobe,
          .angular_resolution = sonar_lobe,
          .max_range = sonar_range};
}

std::optional<hw::player::RangerValues> RobotFace::ranger_values(const DeviceName& ranger) const {
  const bool is_laser = ranger == kLaserRanger;
  if (is_laser ? !scan : !sonar) return std::nullopt;
  const std::vector<float>& ranges = is_laser ? scan->ranges : sonar->ranges;
  return hw::player::RangerValues{{ranges.begin(), ranges.end()}};
}

void RobotFace::take(const idl::Odometry& odometry) {
  state =
      hw::player::Position2dState{.pose = {odometry.x(), odometry.y(), odometry.steer_angle()},
                                  .velocity = {odometry.translational_velocity(),
                                               odometry.sideways_velocity(), odometry.steering_velocity()}};
}

void RobotFace::take(const idl::SonarRangeReadings& readings) {
  sonar = hw::player::SonarRanges{shown(readings.ranges(), readings.max_range())};
  sonar_lobe = 2.0 * readings.half_lobe();
  sonar_range = readings.max_range();
  sonar_poses.poses.clear();
  for (const idl::Frame3D& mount : readings.poses()) {
    const Pose2 pose = plane_pose(mount);
    sonar_poses.poses.push_back({.x = pose.x, .y = pose.y, .z = mount.position().z(), .yaw = pose.yaw});
  }
}

void RobotFace::take(const idl::LaserRangeReadings& readings) {
  const auto count = static_cast<double>(std::max<std::size_t>(readings.ranges().size(), 1));
  const auto first = static_cast<float>(readings.angle_start());
  const auto step = static_cast<float>(readings.angle_increment());
  const auto last = static_cast<float>(readings.angle_start() + (count - 1.0) * readings.angle_increment());
  const auto longest = static_cast<float>(readings.max_range());
  scan = hw::player::LaserScan{.min_angle = first,
                               .max_angle = last,
                               .resolution = step,
                               .max_range = longest,
                               .ranges = shown(readings.ranges(), readings.max_range()),
                               .id = ++scans_};
  laser_config = {.min_angle = first, .max_angle = last, .resolution = step, .max_range = longest};
  const Pose2 mount = plane_pose(readings.pose());
  laser_pose = {.x = mount.x, .y = mount.y, .z = readings.pose().position().z(), .yaw = mount.yaw};
}

}  // namespace orca::player_server
