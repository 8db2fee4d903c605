// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ranger_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/geometry/pose2.hpp"
#include "orca/hw/player/payload.hpp"

namespace orca::hw::player {
namespace {

// A server may say anything: what no float can hold becomes the largest that it is cut to. Not a number stays so.
float in_single(double value) { return static_cast<float>(std::clamp(value, -1e30, 1e30)); }

std::vector<float> in_single(const std::vector<double>& ranges) {
  std::vector<float> all;
  all.reserve(ranges.size());
  for (const double range : ranges) all.push_back(in_single(range));
  return all;
}

bool has_angles(const RangerConfig& config) {
  return std::isfinite(config.min_angle) && std::isfinite(config.max_angle) &&
         config.max_angle > config.min_angle;
}

}  // namespace

std::optional<Result<RangerStamped>> read_ranges(const Message& message) {
  const MessageId id = id_of(message.header);
  if (id == kRangerStamped) return decode<RangerStamped>(message.payload);
  if (id != kRangerRanges) return std::nullopt;
  Result<RangerValues> values = decode<RangerValues>(message.payload);
  if (!values) return Result<RangerStamped>(values.error());
  return Result<RangerStamped>(RangerStamped{.ranges = std::move(*values)});
}

SonarRanges as_sonar(const RangerValues& values) { return {in_single(values.values)}; }

SonarGeometry as_sonar(const RangerGeometry& geometry) {
  const Pose2 device{geometry.pose.x, geometry.pose.y, geometry.pose.yaw};
  SonarGeometry sonars;
  for (const Pose3& element : geometry.element_poses) {
    const Pose2 place = device * Pose2{element.x, element.y, element.yaw};
    sonars.poses.push_back({.x = place.x, .y = place.y, .z = geometry.pose.z + element.z, .yaw = place.yaw});
  }
  return sonars;
}

LaserScan as_laser(const RangerValues& values, const std::optional<RangerConfig>& config,
                   const RangerConfig& otherwise) {
  const RangerConfig& angles = config && has_angles(*config) ? *config : otherwise;
  const bool has_limit = config && std::isfinite(config->max_range) && config->max_range > 0.0;
  const double steps = static_cast<double>(std::max<std::size_t>(values.values.size(), 2) - 1);
  return {.min_angle = in_single(angles.min_angle),
          .max_angle = in_single(angles.max_angle),
          .resolution = in_single((angles.max_angle - angles.min_angle) / steps),
          .max_range = in_single(has_limit ? config->max_range : otherwise.max_range),
          .ranges = in_single(values.values)};
}

}  // namespace orca::hw::player
