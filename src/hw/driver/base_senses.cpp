// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/base_senses.hpp"

#include <algorithm>
#include <span>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/ranges.hpp"
#include "orca/idl/time.hpp"

namespace orca::hw {
namespace {

constexpr double kLowCharge = 0.15;     // [1] below which a battery is low
constexpr double kEnoughCharge = 0.25;  // [1] from which on one that was is not any more

}  // namespace

void BaseSonars::add(const Pose2& place, double height) {
  sonars_.push_back({level_frame(place, height), traits_.max_range, traits_.max_range, {}});
}

void BaseSonars::clear() { sonars_.clear(); }

void BaseSonars::take(std::size_t sonar, double range, TimePoint stamp) {
  sonars_[sonar].told = range;
  sonars_[sonar].range = std::min(range, traits_.max_range);
  sonars_[sonar].stamp = stamp;
}

void BaseSonars::forget() {
  for (Sonar& sonar : sonars_) {
    sonar.told = std::nan("");  // which is no range: each is new
    sonar.range = traits_.max_range;
  }
}

void BaseSonars::publish(TimePoint stamp) {
  auto object = endpoint_.loan();
  for (const Sonar& sonar : sonars_) {
    object->ranges().push_back(sonar.range);
    object->poses().push_back(sonar.place);
    object->stamps().push_back(to_time_value(sonar.stamp));
  }
  object->min_range(traits_.min_range);
  object->max_range(traits_.max_range);
  object->half_lobe(traits_.half_lobe);
  object->pose(level_pose({}, sonars_.empty() ? 0.0 : sonars_.front().place.position().z(), stamp));
  set_uncertainty(*object, traits_.errors);
  endpoint_.publish(std::move(object));
}

void BaseSonars::publish_round(TimePoint stamp) {
  if (stamp - published_ < traits_.cycle) return;
  published_ = stamp;
  publish(stamp);
}

idl::SonarRing BaseSonars::describe(const std::string& name) const {
  idl::SonarRing ring;
  ring.name(name);
  ring.type(std::string(endpoint_.type().name));
  ring.update_interval(to_seconds(endpoint_.period()));
  ring.number(static_cast<std::uint32_t>(sonars_.size()));
  ring.angle_sonar0(sonars_.empty() ? 0.0 : sonars_.front().place.rotation().yaw());
  ring.half_lobe(traits_.half_lobe);
  ring.min_range(traits_.min_range);
  ring.max_range(traits_.max_range);
  return ring;
}

void BaseBumpers::add(const std::string& name, double direction) {
  const Vec2 faces = orca::direction(direction);
  switches_.push_back({name, faces, faces, false});
}

void BaseBumpers::take(std::size_t number, bool is_pressed, const Vec2& way) {
  Switch& at = switches_[number];
  if (!is_pressed) at.outwards = at.faces;
  if (is_pressed && !at.is_pressed && !(way == Vec2{})) at.outwards = (1.0 / norm(way)) * way;
  at.is_pressed = is_pressed;
}

void BaseBumpers::forget() {
  for (std::size_t i = 0; i < switches_.size(); ++i) take(i, false);
}

std::vector<Obstruction::Pressed> BaseBumpers::pressed() const {
  std::vector<Obstruction::Pressed> all;
  for (const Switch& at : switches_)
    if (at.is_pressed) all.push_back({at.outwards, at.name});
  return all;
}

void BaseBumpers::publish(TimePoint stamp, std::size_t most) {
  auto object = endpoint_.loan();
  for (const Switch& at : std::span(switches_).first(std::min(most, switches_.size()))) {
    object->pressed().push_back(at.is_pressed);
    object->names().push_back(at.name);
    if (radius_ <= 0.0) continue;
    const Vec2 place = radius_ * at.outwards;
    object->poses().push_back(
        level_frame({place.x, place.y, portable::atan2(at.outwards.y, at.outwards.x)}, 0.0));
  }
  object->stamp(to_time_value(stamp));
  endpoint_.publish(std::move(object));
}

void ChargeWatch::take(const BatteryReading& reading) {
  if (std::isnan(reading.charge)) return;
  const bool is_low = !reading.charging && reading.charge < (is_low_ ? kEnoughCharge : kLowCharge);
  if (!std::exchange(is_low_, is_low) && is_low)
    remark_ = "its battery is low, at " + std::to_string(std::lround(100.0 * reading.charge)) +
              " % of its charge; charge it";
}

void publish_battery(SensorHW<idl::Battery>& endpoint, const BatteryReading& reading, TimePoint stamp) {
  auto object = endpoint.loan();
  object->name(reading.name);
  object->voltage(reading.voltage);
  object->current(std::nan(""));
  object->charge(reading.charge);
  object->charging(reading.charging);
  object->temperature(reading.temperature);
  object->stamp(to_time_value(stamp));
  endpoint.publish(std::move(object));
}

}  // namespace orca::hw
