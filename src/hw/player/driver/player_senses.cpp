// SPDX-License-Identifier: LGPL-3.0-or-later
#include "player_senses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace orca::hw::player {
namespace {

constexpr Duration kDataPeriod = 100ms;                        // of most drivers
constexpr Duration kSonarCycle = 400ms;                        // in which a ring of a Pioneer has fired once
constexpr double kHalfLobe = 12.5 * std::numbers::pi / 180.0;  // [rad] of a Polaroid transducer

bool is_finite(const Planar& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.yaw); }

Pose2 plane_pose(const Pose3& pose) { return {pose.x, pose.y, pose.yaw}; }

bool is_finite(const Pose3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.yaw);
}

// What is no distance means that nothing was seen.
double distance(double range, double longest) { return range >= 0.0 && range < longest ? range : longest; }

}  // namespace

PlayerSenses::PlayerSenses(const std::vector<Use>& uses, const PlayerRobotShape& shape)
    : shape_(shape),
      odometry_(kDataPeriod),
      sonars_({.max_range = shape.sonar_range, .half_lobe = kHalfLobe, .cycle = kSonarCycle}, kDataPeriod),
      laser_(kDataPeriod),
      bumpers_(kDataPeriod, shape.radius),
      battery_(kDataPeriod),
      endpoints_{&odometry_.endpoint()} {
  const auto add = [&](Part part, SensorEndpoint& endpoint) {
    if (std::ranges::count(uses, part, &Use::part) > 0) endpoints_.push_back(&endpoint);
  };
  add(Part::sonar, sonars_.endpoint());
  add(Part::laser, laser_);
  add(Part::bumper, bumpers_.endpoint());
  add(Part::power, battery_);
}

void PlayerSenses::connect(const PlayerRobotFacts& facts) {
  server_zero_.reset();
  bumpers_.clear();
  learn(facts);
}

void PlayerSenses::learn(const PlayerRobotFacts& facts) {
  facts_ = facts;
  sonars_.clear();
  if (!facts_.sonars) return;
  for (const Pose3& place : facts_.sonars->poses) sonars_.add(plane_pose(place), place.z);
}

bool PlayerSenses::take(const Position2dState& state, TimePoint stamp, bool publish) {
  if (!is_finite(state.pose) || !is_finite(state.velocity)) return false;
  const Pose2 told{state.pose.x, state.pose.y, state.pose.yaw};
  if (!server_zero_) server_zero_ = pose_ * inverse(told);
  pose_ = *server_zero_ * told;
  if (publish) odometry_.publish(pose_, {state.velocity.x, 0.0, state.velocity.yaw}, stamp);
  return true;
}

// Which sonars have fired since the last message is not said.
bool PlayerSenses::take(const SonarRanges& ranges, TimePoint stamp, bool publish) {
  if (ranges.ranges.size() != sonars_.count()) return false;
  sonars_.take_all(stamp, [&](std::size_t i) { return distance(ranges.ranges[i], shape_.sonar_range); });
  if (publish && sonars_.count() > 0) sonars_.publish(stamp);
  return true;
}

bool PlayerSenses::take(const LaserScan& scan, TimePoint stamp, bool publish) {
  const double longest = scan.max_range;
  const bool has_sense = std::isfinite(scan.min_angle) && std::isfinite(scan.resolution) &&
                         scan.resolution > 0.0F && std::isfinite(longest) && longest > 0.0 &&
                         !scan.ranges.empty();
  if (!has_sense) return false;
  if (!publish) return true;
  const Pose3 place = facts_.laser && is_finite(facts_.laser->pose) ? facts_.laser->pose : Pose3{};
  auto object = laser_.loan();
  for (const float range : scan.ranges) object->ranges().push_back(distance(range, longest));
  object->min_range(0.0);
  object->max_range(longest);
  object->pose(level_pose(plane_pose(place), place.z, stamp));
  object->stamp(to_time_value(stamp));
  object->angle_start(scan.min_angle);
  object->angle_increment(scan.resolution);
  object->time_increment(0.0);  // not known
  laser_.publish(std::move(object));
  return true;
}

bool PlayerSenses::take(const BumperState& bumpers, double forward, TimePoint stamp, bool publish) {
  const std::size_t count = bumpers.pressed.size();
  if (count != bumpers_.count()) bumpers_.clear();
  for (std::size_t i = bumpers_.count(); i < count; ++i)
    bumpers_.add("bumper " + std::to_string(i + 1),
                 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count));
  for (std::size_t i = 0; i < count; ++i) bumpers_.take(i, bumpers.pressed[i] != 0, {forward, 0.0});
  if (publish) bumpers_.publish(stamp);
  return true;
}

bool PlayerSenses::take(const PowerState& power, TimePoint stamp, bool publish) {
  if (!publish) return true;
  const BatteryReading reading{
      .voltage = power.voltage ? *power.voltage : std::nan(""),
      .charge = power.charge ? std::clamp(0.01 * *power.charge, 0.0, 1.0) : std::nan(""),
      .charging = power.charging.value_or(0) == 1};
  charge_.take(reading);
  publish_battery(battery_, reading, stamp);
  return true;
}

}  // namespace orca::hw::player
