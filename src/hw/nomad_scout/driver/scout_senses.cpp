// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scout_senses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "orca/geometry/angle.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/ranges.hpp"
#include "orca/idl/time.hpp"

namespace orca::hw::nomad_scout {
namespace {

constexpr double kShortestRange = 0.15;                        // [m] the ring of its own ping
constexpr double kLongestRange = 6.5;                          // [m]
constexpr double kHalfLobe = 12.5 * std::numbers::pi / 180.0;  // [rad] of a Polaroid transducer
constexpr double kSonarHeight = 0.28;                          // [m] above the floor
constexpr std::size_t kSwitches = 6;                           // around the robot
constexpr Duration kClockEnd = std::chrono::hours(1193);  // of 32 bits of milliseconds, but for two minutes

// From ahead to the left, as the sonars are counted.
Vec2 outwards(std::size_t number) {
  return direction(wrapped(static_cast<double>(number) * 2.0 * std::numbers::pi / kSwitches));
}

std::string bumper_name(std::size_t number) { return "bumper " + std::to_string(number); }

}  // namespace

ScoutSenses::ScoutSenses(double track, Duration cycle)
    : track_(track), cycle_(cycle), odometry_(kPeriod), sonar_(cycle), bumpers_(kPeriod), battery_(kPeriod) {}

std::vector<SensorEndpoint*> ScoutSenses::endpoints() {
  return {&odometry_.endpoint(), &battery_, &sonar_, &bumpers_};
}

idl::SonarRing ScoutSenses::describe_sonars() const {
  idl::SonarRing ring;
  ring.name("sonars");
  ring.type("SonarRangeReadings");
  ring.update_interval(to_seconds(cycle_));
  ring.number(kSonars);
  ring.dphi(2.0 * std::numbers::pi / kSonars);
  ring.radius(kRadius);
  ring.half_lobe(kHalfLobe);
  ring.min_range(kShortestRange);
  ring.max_range(kLongestRange);
  return ring;
}

void ScoutSenses::connect() {
  wheels_.forget();
  heading_offset_.reset();
  state_ = {};
}

bool ScoutSenses::has_restarted(const State& next) const {
  return next.controller_time < state_.controller_time && state_.controller_time < kClockEnd;
}

void ScoutSenses::take(const State& state, TimePoint stamp, double forward) {
  stamp_ = stamp;
  if (!heading_offset_) heading_offset_ = wrapped(pose_.yaw - state.heading);
  const Vec2 step = rotated(wheels_.add(state.position), *heading_offset_);
  pose_ = {pose_.x + step.x, pose_.y + step.y, wrapped(state.heading + *heading_offset_)};
  const double measured = twist_of(state.speeds, track_).forward;
  take_touches(state.bumpers, forward != 0.0 ? forward : measured);
  take_sonars(state.sonars);
  state_ = state;
}

void ScoutSenses::take_touches(unsigned bits, double forward) {
  for (std::size_t i = 0; i < kBits; ++i) {
    if ((((bits & ~state_.bumpers) >> i) & 1U) == 0) continue;
    outwards_[i] = forward != 0.0 ? Vec2{std::copysign(1.0, forward), 0.0} : outwards(i);
  }
}

// The state does not say which sonar has fired since the last one. A range that has changed was measured now, and one that has
// not at most a whole cycle ago.
void ScoutSenses::take_sonars(const SonarRanges& ranges) {
  for (std::size_t i = 0; i < kSonars; ++i) {
    const bool is_new = ranges[i] != state_.sonars[i];
    stamps_[i] = is_new ? stamp_ : std::max(stamps_[i], stamp_ - cycle_);
    ranges_[i] = std::min(ranges[i], kLongestRange);
  }
}

void ScoutSenses::publish() {
  publish_odometry();
  publish_battery();
  publish_sonars();
  publish_bumpers();
}

void ScoutSenses::publish_odometry() { odometry_.publish(pose_, twist_of(state_.speeds, track_), stamp_); }

// Once in a cycle: an old range that is published again would count as another echo.
void ScoutSenses::publish_sonars() {
  if (stamp_ - sonars_published_ < cycle_) return;
  sonars_published_ = stamp_;
  auto object = sonar_.loan();
  object->ranges().assign(ranges_.begin(), ranges_.end());
  for (std::size_t i = 0; i < kSonars; ++i) {
    object->poses().push_back(level_frame(sonar_pose(i, kRadius), kSonarHeight));
    object->stamps().push_back(to_time_value(stamps_[i]));
  }
  object->min_range(kShortestRange);
  object->max_range(kLongestRange);
  object->half_lobe(kHalfLobe);
  object->pose(level_pose({}, kSonarHeight, stamp_));
  set_uncertainty(*object, sonar_errors_);
  sonar_.publish(std::move(object));
}

void ScoutSenses::publish_bumpers() {
  auto object = bumpers_.loan();
  for (std::size_t i = 0; i < kSwitches; ++i) {
    const Pose2 facing{0.0, 0.0, wrapped(static_cast<double>(i) * 2.0 * std::numbers::pi / kSwitches)};
    const Vec2 place = facing * Vec2{kBumperRadius, 0.0};
    object->pressed().push_back((state_.bumpers >> i) & 1U);
    object->names().push_back(bumper_name(i));
    object->poses().push_back(level_frame({place.x, place.y, facing.yaw}, 0.0));
  }
  object->stamp(to_time_value(stamp_));
  bumpers_.publish(std::move(object));
}

void ScoutSenses::publish_battery() {
  auto object = battery_.loan();
  object->name("drive");
  object->voltage(state_.motor_voltage);
  object->current(std::nan(""));
  object->charge(std::nan(""));
  object->stamp(to_time_value(stamp_));
  battery_.publish(std::move(object));
}

std::vector<Obstruction::Pressed> ScoutSenses::pressed() const {
  std::vector<Obstruction::Pressed> all;
  for (std::size_t i = 0; i < kBits; ++i)
    if (((state_.bumpers >> i) & 1U) != 0) all.push_back({outwards_[i], bumper_name(i)});
  return all;
}

}  // namespace orca::hw::nomad_scout
