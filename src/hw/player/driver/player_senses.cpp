// SPDX-License-Identifier: LGPL-3.0-or-later
#include "player_senses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "orca/base/portable_math.hpp"
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
      sonar_(kDataPeriod),
      laser_(kDataPeriod),
      bumpers_(kDataPeriod),
      battery_(kDataPeriod),
      endpoints_{&odometry_} {
  const auto add = [&](Part part, SensorEndpoint& endpoint) {
    if (std::ranges::count(uses, part, &Use::part) > 0) endpoints_.push_back(&endpoint);
  };
  add(Part::sonar, sonar_);
  add(Part::laser, laser_);
  add(Part::bumper, bumpers_);
  add(Part::power, battery_);
}

void PlayerSenses::connect(const PlayerRobotFacts& facts) {
  server_zero_.reset();
  touched_.clear();
  learn(facts);
}

void PlayerSenses::learn(const PlayerRobotFacts& facts) {
  facts_ = facts;
  const std::size_t sonars = facts_.sonars ? facts_.sonars->poses.size() : 0;
  ranges_.assign(sonars, shape_.sonar_range);
  stamps_.assign(sonars, TimePoint{});
}

bool PlayerSenses::take(const Position2dState& state, TimePoint stamp, bool publish) {
  if (!is_finite(state.pose) || !is_finite(state.velocity)) return false;
  const Pose2 told{state.pose.x, state.pose.y, state.pose.yaw};
  if (!server_zero_) server_zero_ = pose_ * inverse(told);
  pose_ = *server_zero_ * told;
  if (!publish) return true;
  auto object = odometry_.loan();
  object->x(pose_.x);
  object->y(pose_.y);
  object->steer_angle(pose_.yaw);
  object->translational_velocity(state.velocity.x);
  object->steering_velocity(state.velocity.yaw);
  object->stamp(to_time_value(stamp));
  odometry_.publish(std::move(object));
  return true;
}

// Which sonars have fired since the last message is not said. A range that has changed was measured now, and one that has not at most a
// whole cycle ago.
bool PlayerSenses::take(const SonarRanges& ranges, TimePoint stamp, bool publish) {
  if (ranges.ranges.size() != ranges_.size()) return false;
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const double range = distance(ranges.ranges[i], shape_.sonar_range);
    stamps_[i] = range != ranges_[i] ? stamp : std::max(stamps_[i], stamp - kSonarCycle);
    ranges_[i] = range;
  }
  if (publish && !ranges_.empty()) publish_sonars(stamp);
  return true;
}

void PlayerSenses::publish_sonars(TimePoint stamp) {
  auto object = sonar_.loan();
  object->ranges().assign(ranges_.begin(), ranges_.end());
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    const Pose3& pose = facts_.sonars->poses[i];
    object->poses().push_back(level_frame(plane_pose(pose), pose.z));
    object->stamps().push_back(to_time_value(stamps_[i]));
  }
  object->min_range(0.0);
  object->max_range(shape_.sonar_range);
  object->half_lobe(kHalfLobe);
  object->pose(level_pose({}, ranges_.empty() ? 0.0 : facts_.sonars->poses[0].z, stamp));
  sonar_.publish(std::move(object));
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

Vec2 PlayerSenses::outwards(std::size_t bumper) const {
  return direction(2.0 * std::numbers::pi * static_cast<double>(bumper) /
                   static_cast<double>(touched_.size()));
}

bool PlayerSenses::take(const BumperState& bumpers, double forward, TimePoint stamp, bool publish) {
  touched_.resize(bumpers.pressed.size());
  touched_at_.resize(bumpers.pressed.size());
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    const bool is_new = bumpers.pressed[i] != 0 && touched_[i] == 0;
    if (is_new) touched_at_[i] = forward != 0.0 ? Vec2{std::copysign(1.0, forward), 0.0} : outwards(i);
    touched_[i] = bumpers.pressed[i] != 0 ? 1 : 0;
  }
  if (publish) publish_bumpers(stamp);
  return true;
}

void PlayerSenses::publish_bumpers(TimePoint stamp) {
  auto object = bumpers_.loan();
  for (std::size_t i = 0; i < touched_.size(); ++i) {
    const Vec2 out = touched_[i] != 0 ? touched_at_[i] : outwards(i);
    object->pressed().push_back(touched_[i]);
    object->names().push_back("bumper " + std::to_string(i + 1));
    object->poses().push_back(
        level_frame({shape_.radius * out.x, shape_.radius * out.y, portable::atan2(out.y, out.x)}, 0.0));
  }
  object->stamp(to_time_value(stamp));
  bumpers_.publish(std::move(object));
}

bool PlayerSenses::take(const PowerState& power, TimePoint stamp, bool publish) {
  if (!publish) return true;
  auto object = battery_.loan();
  object->name("drive");
  object->voltage(power.voltage ? *power.voltage : std::nan(""));
  object->current(std::nan(""));
  object->charge(power.charge ? std::clamp(0.01 * *power.charge, 0.0, 1.0) : std::nan(""));
  object->charging(power.charging.value_or(0) == 1);
  object->stamp(to_time_value(stamp));
  battery_.publish(std::move(object));
  return true;
}

std::vector<Obstruction::Pressed> PlayerSenses::pressed() const {
  std::vector<Obstruction::Pressed> all;
  for (std::size_t i = 0; i < touched_.size(); ++i)
    if (touched_[i] != 0) all.push_back({touched_at_[i], "bumper " + std::to_string(i + 1)});
  return all;
}

}  // namespace orca::hw::player
