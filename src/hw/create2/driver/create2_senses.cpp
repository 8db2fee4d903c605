// SPDX-License-Identifier: LGPL-3.0-or-later
#include "create2_senses.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "orca/geometry/arc.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace orca::hw::create2 {
namespace {

struct Place {
  const char* name;
  double direction;  // [rad] from ahead, positive to the left
};

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::array<Place, 2> kBumpers{{{"left", 45.0 * kDegree}, {"right", -45.0 * kDegree}}};
constexpr std::array<Place, 4> kCliffs{{{"cliff left", 60.0 * kDegree},
                                        {"cliff front left", 20.0 * kDegree},
                                        {"cliff front right", -20.0 * kDegree},
                                        {"cliff right", -60.0 * kDegree}}};

}  // namespace

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
  publish_bumpers();
  publish_battery();
}

void Create2Senses::publish_odometry() {
  const double time = to_seconds(stamp_ - std::exchange(since_, stamp_).value_or(stamp_));
  const Travel2 travel = std::exchange(travel_, Travel2{});
  const Twist2 velocity = time > 0.0 ? travel / time : Twist2{};
  odometry_.publish(pose_, velocity, stamp_);
}

void Create2Senses::publish_bumpers() {
  const BumpsAndDrops touched = sensors_.bumps_and_drops.value_or(BumpsAndDrops{});
  auto object = bumpers_.loan();
  for (const Place& bumper : kBumpers) {
    const Vec2 place = kRadius * direction(bumper.direction);
    object->pressed().push_back(&bumper == &kBumpers[0] ? touched.bump_left : touched.bump_right);
    object->names().push_back(bumper.name);
    object->poses().push_back(level_frame({place.x, place.y, bumper.direction}, 0.0));
  }
  object->stamp(to_time_value(stamp_));
  bumpers_.publish(std::move(object));
}

void Create2Senses::publish_battery() {
  if (!sensors_.voltage) return;
  auto object = battery_.loan();
  object->name("drive");
  object->voltage(*sensors_.voltage);
  object->current(std::nan(""));
  object->charge(state_of_charge(sensors_).value_or(std::nan("")));
  const ChargingState charging = sensors_.charging_state.value_or(ChargingState::not_charging);
  object->charging(charging == ChargingState::full || charging == ChargingState::trickle ||
                   charging == ChargingState::reconditioning);
  object->stamp(to_time_value(stamp_));
  battery_.publish(std::move(object));
}

std::vector<Obstruction::Pressed> Create2Senses::pressed() const {
  const BumpsAndDrops touched = sensors_.bumps_and_drops.value_or(BumpsAndDrops{});
  std::vector<Obstruction::Pressed> all;
  const auto add = [&](const Place& place) { all.push_back({direction(place.direction), place.name}); };
  if (touched.bump_left) add(kBumpers[0]);
  if (touched.bump_right) add(kBumpers[1]);
  for (std::size_t i = 0; i < kCliffs.size(); ++i)
    if (sensors_.cliffs[i].value_or(false)) add(kCliffs[i]);
  return all;
}

bool Create2Senses::wheel_hangs() const {
  const BumpsAndDrops hanging = sensors_.bumps_and_drops.value_or(BumpsAndDrops{});
  return hanging.drop_left || hanging.drop_right;
}

bool Create2Senses::is_stalled() const {
  const Overcurrents currents = sensors_.overcurrents.value_or(Overcurrents{});
  return currents.left_wheel || currents.right_wheel;
}

bool Create2Senses::is_at_charger() const {
  const ChargingSources sources = sensors_.charging_sources.value_or(ChargingSources{});
  return sources.internal || sources.home_base;
}

}  // namespace orca::hw::create2
