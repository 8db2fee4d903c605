// SPDX-License-Identifier: LGPL-3.0-or-later
#include "senses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "orca/geometry/angle.hpp"
#include "orca/hw/p2os/gripper.hpp"
#include "orca/idl/time.hpp"

namespace orca::hw::p2os {
namespace {

constexpr Duration kPeriod = 100ms;                            // of packets
constexpr double kShortestRange = 0.15;                        // [m] the ring of its own ping
constexpr double kLongestRange = 5.0;                          // [m]
constexpr double kHalfLobe = 12.5 * std::numbers::pi / 180.0;  // [rad] of a Polaroid transducer
constexpr double kBumperArc = 0.75 * std::numbers::pi;         // [rad] in front, and in the rear
constexpr std::size_t kNowhere = ~std::size_t{0};
constexpr double kSonarHeight = 0.24;  // [m] of the front ring above the floor

}  // namespace

// From the left to the right in front, and from the right to the left behind.
std::vector<double> Senses::usual_bumpers(const Model& model) {
  std::vector<double> all;
  const auto add = [&](double middle, int number) {
    for (int i = 0; i < number; ++i) all.push_back(wrapped(middle + kBumperArc * (0.5 - (i + 0.5) / number)));
  };
  add(0.0, model.front_bumpers);
  add(std::numbers::pi, model.rear_bumpers);
  return all;
}

Senses::Senses(const Model& model, const Extras& extras, const SenseTraits& traits)
    : model_(model),
      units_(&model),
      has_gripper_(extras.has_gripper),
      odometry_(kPeriod, traits),
      sonars_({.min_range = kShortestRange,
               .max_range = kLongestRange,
               .half_lobe = kHalfLobe,
               .errors = traits.sonars},
              kPeriod),
      bumpers_(kPeriod, extras.bumper_radius),
      battery_(kPeriod),
      gripper_(kPeriod) {
  find_sonars();
  add_bumpers(extras.bumpers);
}

void Senses::find_sonars() {
  for (std::size_t i = 0; i < model_.sonar_poses.size(); ++i) {
    const bool is_absent = (model_.absent_sonars >> i & 1U) != 0;
    places_.push_back(is_absent ? kNowhere : sonars_.count());
    if (!is_absent) sonars_.add(model_.sonar_poses[i], kSonarHeight);
  }
}

std::vector<SensorEndpoint*> Senses::endpoints() {
  std::vector<SensorEndpoint*> all{&odometry_.endpoint(), &battery_};
  if (sonars_.count() > 0) all.push_back(&sonars_.endpoint());
  if (bumpers_.count() > 0) all.push_back(&bumpers_.endpoint());
  if (has_gripper_) all.push_back(&gripper_);
  return all;
}

std::optional<idl::SonarRing> Senses::describe_sonars() const {
  if (sonars_.count() == 0) return std::nullopt;
  idl::SonarRing ring = sonars_.describe("sonars");
  ring.scale_factor(model_.range_unit);
  return ring;
}

void Senses::connect(const Model& units) {
  units_ = &units;
  counted_.forget();
  sonars_.forget();
}

void Senses::take(const Sip& sip, TimePoint stamp) {
  sip_ = sip;
  stamp_ = stamp;
  counted_.take(sip.x, sip.y, units_->distance_unit, sip.heading);
  for (const SonarEcho& echo : sip.echoes) {
    const std::size_t place = echo.index < places_.size() ? places_[echo.index] : kNowhere;
    if (place != kNowhere) sonars_.take(place, echo.range, stamp);
  }
  for (std::size_t i = 0; i < bits_.size(); ++i)
    bumpers_.take(
        i, (((bits_[i].is_front ? sip.front_bumpers : sip.rear_bumpers) >> bits_[i].number) & 1U) != 0);
}

void Senses::publish() {
  publish_odometry();
  publish_battery();
  if (sonars_.count() > 0 && !sip_.echoes.empty()) sonars_.publish(stamp_);
  if (bumpers_.count() > 0) bumpers_.publish(stamp_);
  if (has_gripper_ && sip_.ports) publish_gripper();
}

void Senses::publish_odometry() {
  const Twist2 velocity{0.5 * (sip_.left_speed + sip_.right_speed), 0.0,
                        0.5 * (sip_.right_speed - sip_.left_speed) / units_->half_track};
  odometry_.publish(counted_.pose(), velocity, stamp_);
}

void Senses::publish_battery() {
  const std::optional<std::uint8_t>& percent = sip_.tail.state_of_charge;
  const int charge = sip_.tail.charge_state.value_or(0);
  hw::publish_battery(battery_,
                      {.voltage = sip_.tail.real_battery_voltage.value_or(sip_.battery_voltage),
                       .charge = percent ? std::min(0.01 * *percent, 1.0) : std::nan(""),
                       .charging = charge > 0 && charge < 255,
                       .temperature = sip_.tail.temperature.value_or(std::nan(""))},
                      stamp_);
}

// Paddles that have closed on nothing press on each other, so only the beams tell that something is between them.
void Senses::publish_gripper() {
  const GripperState state = gripper_of(*sip_.ports);
  const bool holds = state.left_contact && state.right_contact && !state.paddles_move &&
                     (state.inner_beam || state.outer_beam);
  auto object = gripper_.loan();
  object->open(state.open);
  object->closed(state.closed && !holds);
  object->paddles_move(state.paddles_move);
  object->up(state.up);
  object->down(state.down);
  object->lift_moves(state.lift_moves);
  object->inner_beam(state.inner_beam);
  object->outer_beam(state.outer_beam);
  object->holds(holds);
  object->stamp(to_time_value(stamp_));
  gripper_.publish(std::move(object));
}

// The controller counts them clockwise: in front from the left to the right, behind from the right to the left.
void Senses::add_bumpers(std::vector<double> directions) {
  const auto from_the_left = [](double direction) {
    const double clockwise = 0.5 * std::numbers::pi - direction;
    return clockwise < 0.0 ? clockwise + 2.0 * std::numbers::pi : clockwise;
  };
  std::ranges::sort(directions, {}, from_the_left);
  unsigned front = 0;
  unsigned rear = 0;
  for (const double direction : directions) {
    const bool is_front = std::abs(direction) < 0.5 * std::numbers::pi;
    bits_.push_back({is_front, is_front ? front++ : rear++});
    bumpers_.add((is_front ? "front " : "rear ") + std::to_string(bits_.back().number + 1), direction);
  }
}

}  // namespace orca::hw::p2os
