// SPDX-License-Identifier: LGPL-3.0-or-later
#include "xr4000_senses.hpp"

#include <limits>
#include <string>

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

XrSenses::XrSenses(Duration cycle, const BatteryScale& scale, const SenseTraits& traits)
    : scale_(scale),
      odometry_(kReadingPeriod, traits),
      sonars_({.min_range = kNearest,
               .max_range = kFarthest,
               .half_lobe = kHalfLobe,
               .cycle = cycle,
               .errors = traits.sonars},
              cycle),
      bumpers_(kReadingPeriod),
      battery_(kBatteryPeriod) {
  for (std::size_t i = 0; i < kSonars; ++i) sonars_.add(sonar_place(i), height_of(i));
  for (std::size_t i = 0; i < kSwitches; ++i)
    bumpers_.add(name_of(switch_at(i)), door_direction(door_of(switch_at(i).set)));
}

std::vector<SensorEndpoint*> XrSenses::endpoints() {
  std::vector<SensorEndpoint*> all{&odometry_.endpoint(), &sonars_.endpoint(), &bumpers_.endpoint()};
  if (has_battery()) all.push_back(&battery_);
  return all;
}

idl::SonarRing XrSenses::describe_sonars() const {
  idl::SonarRing ring = sonars_.describe("sonar");
  ring.radius(kRadius);
  ring.scale_factor(0.001);
  return ring;
}

void XrSenses::connect() {
  integrator_.forget();
  state_ = {};
  bumpers_.forget();
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
    // It does not say when a sonar has fired.
    sonars_.take_all(stamp, [&](std::size_t i) {
      const auto& millimetres = (*readings)[i];
      return millimetres ? 0.001 * *millimetres : kFarthest;
    });
    if (publishes) sonars_.publish_round(stamp);
  } else if (answer.type == Type::get_bumper) {
    const Result<BumperReadings> readings = parse_bumpers(answer);
    if (!readings) return readings.error();
    take_touches(*readings, told);
    if (publishes) bumpers_.publish(stamp);
  } else if (answer.type == Type::get_battery) {
    const Result<BatteryReadings> readings = parse_batteries(answer);
    if (!readings) return readings.error();
    if (publishes)
      hw::publish_battery(battery_,
                          {.voltage = scale_.volts_per_count * readings->at(scale_.channel),
                           .name = "channel " + std::to_string(scale_.channel)},
                          stamp);
  }
  return ok();
}

void XrSenses::take_touches(const BumperReadings& readings, const Twist2& told) {
  const Twist2 measured = velocity_of(state_.speeds);
  const Twist2& velocity = told.forward != 0.0 || told.left != 0.0 ? told : measured;
  for (std::size_t i = 0; i < kSwitches; ++i)
    bumpers_.take(i, readings[i] != Touch::none, {velocity.forward, velocity.left});
}

void XrSenses::publish_state() { odometry_.publish(integrator_.pose(), velocity_of(state_.speeds), stamp_); }

}  // namespace orca::hw::xr4000
