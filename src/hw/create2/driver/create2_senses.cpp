// SPDX-License-Identifier: LGPL-3.0-or-later
#include "create2_senses.hpp"

#include <numbers>
#include <utility>

#include "orca/geometry/arc.hpp"

namespace orca::hw::create2 {
namespace {

struct Place {
  const char* name;
  double direction;  // [rad] from ahead, positive to the left
};

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array<Place, 4> kCliffs{{{"cliff left", 60.0 * kDegree},
                                        {"cliff front left", 20.0 * kDegree},
                                        {"cliff front right", -20.0 * kDegree},
                                        {"cliff right", -60.0 * kDegree}}};

}  // namespace

Create2Senses::Create2Senses(const SenseTraits& traits)
    : odometry_(kPeriod, traits), bumpers_(kPeriod, kRadius), battery_(kPeriod) {
  bumpers_.add("left", 45.0 * kDegree);
  bumpers_.add("right", -45.0 * kDegree);
}

void Create2Senses::connect() {
  wheels_.forget();
  sensors_ = {};
  travel_ = {};
  since_.reset();
  frames_ = 0;
}

void Create2Senses::take(const Sensors& sensors, TimePoint stamp) {
  sensors_ = sensors;
  stamp_ = stamp;
  if (!since_) since_ = stamp;
  bumpers_.take(0, sensors.bumps_and_drops.bump_left);
  bumpers_.take(1, sensors.bumps_and_drops.bump_right);
  if (!sensors.left_counts || !sensors.right_counts) return;
  const Travel2 step = wheels_.add(*sensors.left_counts, *sensors.right_counts);
  pose_ = along_arc(pose_, step);
  travel_.forward += step.forward;
  travel_.turn += step.turn;
}

void Create2Senses::publish() {
  if (++frames_ < kFramesPerReading) return;
  frames_ = 0;
  publish_odometry();
  bumpers_.publish(stamp_);
  publish_battery();
}

void Create2Senses::publish_odometry() {
  const double time = to_seconds(stamp_ - std::exchange(since_, stamp_).value_or(stamp_));
  const Travel2 travel = std::exchange(travel_, Travel2{});
  const Twist2 velocity = time > 0.0 ? travel / time : Twist2{};
  odometry_.publish(pose_, velocity, stamp_);
}

void Create2Senses::publish_battery() {
  if (!sensors_.voltage) return;
  const ChargingState charging = sensors_.charging_state.value_or(ChargingState::not_charging);
  const BatteryReading reading{.voltage = *sensors_.voltage,
                               .charge = state_of_charge(sensors_).value_or(std::nan("")),
                               .charging = charging == ChargingState::full ||
                                           charging == ChargingState::trickle ||
                                           charging == ChargingState::reconditioning};
  charge_.take(reading);
  hw::publish_battery(battery_, reading, stamp_);
}

std::vector<Obstruction::Pressed> Create2Senses::pressed() const {
  std::vector<Obstruction::Pressed> all = bumpers_.pressed();
  for (std::size_t i = 0; i < kCliffs.size(); ++i)
    if (sensors_.cliffs[i]) all.push_back({direction(kCliffs[i].direction), kCliffs[i].name});
  return all;
}

}  // namespace orca::hw::create2
