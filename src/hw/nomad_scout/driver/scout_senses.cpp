// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scout_senses.hpp"

#include <numbers>
#include <string>

namespace orca::hw::nomad_scout {
namespace {

constexpr double kShortestRange = 0.15;                        // [m] the ring of its own ping
constexpr double kLongestRange = 6.5;                          // [m]
constexpr double kHalfLobe = 12.5 * std::numbers::pi / 180.0;  // [rad] of a Polaroid transducer
constexpr double kSonarHeight = 0.28;                          // [m] above the floor
constexpr std::size_t kSwitches = 6;                           // around the robot
constexpr std::size_t kBits = 24;                              // of which some switch has set one
constexpr Duration kClockEnd = std::chrono::hours(1193);  // of 32 bits of milliseconds, but for two minutes

}  // namespace

ScoutSenses::ScoutSenses(double track, Duration cycle, const SenseTraits& traits)
    : track_(track),
      odometry_(kPeriod, traits),
      sonars_({.min_range = kShortestRange,
               .max_range = kLongestRange,
               .half_lobe = kHalfLobe,
               .cycle = cycle,
               .errors = traits.sonars},
              cycle),
      bumpers_(kPeriod, kBumperRadius),
      battery_(kPeriod) {
  for (std::size_t i = 0; i < kSonars; ++i) sonars_.add(sonar_pose(i, kRadius), kSonarHeight);
  for (std::size_t i = 0; i < kBits; ++i)
    bumpers_.add("bumper " + std::to_string(i), static_cast<double>(i) * 2.0 * std::numbers::pi / kSwitches);
}

std::vector<SensorEndpoint*> ScoutSenses::endpoints() {
  return {&odometry_.endpoint(), &battery_, &sonars_.endpoint(), &bumpers_.endpoint()};
}

idl::SonarRing ScoutSenses::describe_sonars() const {
  idl::SonarRing ring = sonars_.describe("sonars");
  ring.dphi(2.0 * std::numbers::pi / kSonars);
  ring.radius(kRadius);
  return ring;
}

void ScoutSenses::connect() {
  counted_.forget();
  sonars_.forget();
  bumpers_.forget();
  state_ = {};
}

bool ScoutSenses::has_restarted(const State& next) const {
  return next.controller_time < state_.controller_time && state_.controller_time < kClockEnd;
}

void ScoutSenses::take(const State& state, TimePoint stamp, double forward) {
  stamp_ = stamp;
  counted_.take(state.position.x, state.position.y, kLengthUnit, state.heading);
  const double measured = twist_of(state.speeds, track_).forward;
  for (std::size_t i = 0; i < kBits; ++i)
    bumpers_.take(i, ((state.bumpers >> i) & 1U) != 0, {forward != 0.0 ? forward : measured, 0.0});
  // It does not say which sonar has fired since the last state.
  sonars_.take_all(stamp, [&](std::size_t i) { return state.sonars[i]; });
  state_ = state;
}

void ScoutSenses::publish() {
  odometry_.publish(counted_.pose(), twist_of(state_.speeds, track_), stamp_);
  publish_battery(battery_, {.voltage = state_.motor_voltage}, stamp_);
  sonars_.publish_round(stamp_);
  bumpers_.publish(stamp_, kSwitches);
}

}  // namespace orca::hw::nomad_scout
