// SPDX-License-Identifier: LGPL-3.0-or-later
#include "xr4000_senses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "orca/geometry/angle.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/ranges.hpp"
#include "orca/idl/time.hpp"

namespace orca::hw::xr4000 {
namespace {

constexpr double kNearest = 0.15;           // [m] an estimate: the ring of its own ping
constexpr double kFarthest = 300 * 0.0254;  // [m] the sensor's word for a time-out, in inches
constexpr double kHalfLobe = 0.5 * 0.209;   // [rad] CARMEN, src/base/xr4000_base
constexpr double kLowRing = 0.3;            // [m] above the floor; both heights are estimates
constexpr double kHighRing = 0.6;           // [m]
constexpr std::uint32_t kClockEnd =
    std::numeric_limits<std::uint32_t>::max() - 120'000;  // [ms] but for two minutes

std::string name_of(const Switch& at) {
  return "set " + std::to_string(at.set) + " switch " + std::to_string(at.number);
}

double height_of(std::size_t sonar) { return sonar / kPerSet % 2 == 0 ? kLowRing : kHighRing; }

}  // namespace

XrSenses::XrSenses(Duration cycle, const BatteryScale& scale)
    : cycle_(cycle),
      scale_(scale),
      odometry_(kReadingPeriod),
      sonar_(cycle),
      bumpers_(kReadingPeriod),
      battery_(kBatteryPeriod) {}

std::vector<SensorEndpoint*> XrSenses::endpoints() {
  std::vector<SensorEndpoint*> all{&odometry_.endpoint(), &sonar_, &bumpers_};
  if (has_battery()) all.push_back(&battery_);
  return all;
}

idl::SonarRing XrSenses::describe_sonars(const std::string& port) const {
  idl::SonarRing ring;
  ring.name("sonar");
  ring.port(port);
  ring.type(std::string(sonar_.type().name));
  ring.update_interval(to_seconds(cycle_));
  ring.number(kSonars);
  ring.radius(kRadius);
  ring.half_lobe(kHalfLobe);
  ring.scale_factor(0.001);
  ring.min_range(kNearest);
  ring.max_range(kFarthest);
  return ring;
}

void XrSenses::connect() {
  integrator_.forget();
  state_ = {};
  touches_ = {};
}

bool XrSenses::has_restarted(const State& next) const {
  return next.time < state_.time && state_.time < kClockEnd;
}

void XrSenses::take(const State& state, TimePoint stamp) {
  stamp_ = stamp;
  state_ = state;
  integrator_.add(state.integrator);
}

Status XrSenses::take(const Message& answer, TimePoint stamp, const Twist2& told, bool publishes) {
  if (answer.type == Type::get_sonar) {
    const Result<SonarReadings> readings = parse_sonars(answer);
    if (!readings) return readings.error();
    take_sonars(*readings, stamp);
    if (publishes) publish_sonars(stamp);
  } else if (answer.type == Type::get_bumper) {
    const Result<BumperReadings> readings = parse_bumpers(answer);
    if (!readings) return readings.error();
    take_touches(*readings, told);
    if (publishes) publish_bumpers(stamp);
  } else if (answer.type == Type::get_battery) {
    const Result<BatteryReadings> readings = parse_batteries(answer);
    if (!readings) return readings.error();
    if (publishes) publish_battery(*readings, stamp);
  }
  return ok();
}

// The answer does not say when a sonar has fired. A range that has changed was measured now, and one that has not at most a whole
// cycle ago.
void XrSenses::take_sonars(const SonarReadings& readings, TimePoint stamp) {
  for (std::size_t i = 0; i < kSonars; ++i)
    stamps_[i] = readings[i] != ranges_[i] ? stamp : std::max(stamps_[i], stamp - cycle_);
  ranges_ = readings;
}

void XrSenses::take_touches(const BumperReadings& readings, const Twist2& told) {
  const Twist2 measured = velocity_of(state_.speeds);
  const Twist2& velocity = told.forward != 0.0 || told.left != 0.0 ? told : measured;
  const Vec2 way{velocity.forward, velocity.left};
  for (std::size_t i = 0; i < kSwitches; ++i) {
    if (readings[i] == Touch::none || touches_[i] != Touch::none) continue;
    outwards_[i] =
        way == Vec2{} ? direction(door_direction(door_of(switch_at(i).set))) : (1.0 / norm(way)) * way;
  }
  touches_ = readings;
}

void XrSenses::publish_state() { odometry_.publish(integrator_.pose(), velocity_of(state_.speeds), stamp_); }

// Once in a cycle: an old range that is published again would count as another echo.
void XrSenses::publish_sonars(TimePoint stamp) {
  if (stamp - sonars_published_ < cycle_) return;
  sonars_published_ = stamp;
  auto object = sonar_.loan();
  for (std::size_t i = 0; i < kSonars; ++i) {
    const double range = ranges_[i] ? 0.001 * *ranges_[i] : kFarthest;
    object->ranges().push_back(std::min(range, kFarthest));
    object->poses().push_back(level_frame(sonar_place(i), height_of(i)));
    object->stamps().push_back(to_time_value(stamps_[i]));
  }
  object->min_range(kNearest);
  object->max_range(kFarthest);
  object->half_lobe(kHalfLobe);
  object->pose(level_pose({}, kLowRing, stamp));
  set_uncertainty(*object, sonar_errors_);
  sonar_.publish(std::move(object));
}

void XrSenses::publish_bumpers(TimePoint stamp) {
  auto object = bumpers_.loan();
  for (std::size_t i = 0; i < kSwitches; ++i) {
    object->pressed().push_back(touches_[i] != Touch::none);
    object->names().push_back(name_of(switch_at(i)));
  }
  object->stamp(to_time_value(stamp));
  bumpers_.publish(std::move(object));
}

void XrSenses::publish_battery(const BatteryReadings& readings, TimePoint stamp) {
  auto object = battery_.loan();
  object->name("channel " + std::to_string(scale_.channel));
  object->voltage(scale_.volts_per_count * readings.at(scale_.channel));
  object->current(std::nan(""));
  object->charge(std::nan(""));
  object->stamp(to_time_value(stamp));
  battery_.publish(std::move(object));
}

std::vector<Obstruction::Pressed> XrSenses::pressed() const {
  std::vector<Obstruction::Pressed> all;
  for (std::size_t i = 0; i < kSwitches; ++i)
    if (touches_[i] != Touch::none) all.push_back({outwards_[i], name_of(switch_at(i))});
  return all;
}

}  // namespace orca::hw::xr4000
