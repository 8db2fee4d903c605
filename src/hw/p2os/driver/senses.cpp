// SPDX-License-Identifier: LGPL-3.0-or-later
#include "senses.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/ranges.hpp"
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

Senses::Senses(const Model& model, const Extras& extras)
    : model_(model),
      units_(&model),
      bumper_ring_(named(extras.bumpers)),
      bumper_radius_(extras.bumper_radius),
      has_gripper_(extras.has_gripper),
      odometry_(kPeriod),
      sonar_(kPeriod),
      bumpers_(kPeriod),
      battery_(kPeriod),
      gripper_(kPeriod),
      wheels_(model.distance_unit) {
  find_sonars();
  ranges_.assign(sonars_.size(), kLongestRange);
  stamps_.resize(sonars_.size());
}

void Senses::find_sonars() {
  for (std::size_t i = 0; i < model_.sonar_poses.size(); ++i) {
    const bool is_absent = (model_.absent_sonars >> i & 1U) != 0;
    places_.push_back(is_absent ? kNowhere : sonars_.size());
    if (!is_absent) sonars_.push_back(model_.sonar_poses[i]);
  }
}

std::vector<SensorEndpoint*> Senses::endpoints() {
  std::vector<SensorEndpoint*> all{&odometry_.endpoint(), &battery_};
  if (!sonars_.empty()) all.push_back(&sonar_);
  if (!bumper_ring_.empty()) all.push_back(&bumpers_);
  if (has_gripper_) all.push_back(&gripper_);
  return all;
}

std::optional<idl::SonarRing> Senses::describe_sonars() const {
  if (sonars_.empty()) return std::nullopt;
  idl::SonarRing ring;
  ring.name("sonars");
  ring.type("SonarRangeReadings");
  ring.update_interval(to_seconds(kPeriod));
  ring.number(static_cast<std::uint32_t>(sonars_.size()));
  ring.angle_sonar0(sonars_.front().yaw);
  ring.half_lobe(kHalfLobe);
  ring.scale_factor(model_.range_unit);
  ring.min_range(kShortestRange);
  ring.max_range(kLongestRange);
  return ring;
}

void Senses::connect(const Model& units) {
  units_ = &units;
  wheels_ = WheelOdometry(units.distance_unit);
  heading_offset_.reset();
  std::ranges::fill(ranges_, kLongestRange);
}

void Senses::take(const Sip& sip, TimePoint stamp) {
  sip_ = sip;
  stamp_ = stamp;
  if (!heading_offset_) heading_offset_ = wrapped(pose_.yaw - sip.heading);
  const Vec2 step = rotated(wheels_.add(sip.x, sip.y), *heading_offset_);
  pose_ = {pose_.x + step.x, pose_.y + step.y, wrapped(sip.heading + *heading_offset_)};
  for (const SonarEcho& echo : sip.echoes) {
    const std::size_t place = echo.index < places_.size() ? places_[echo.index] : kNowhere;
    if (place == kNowhere) continue;
    ranges_[place] = std::min(echo.range, kLongestRange);
    stamps_[place] = stamp;
  }
}

void Senses::publish() {
  publish_odometry();
  publish_battery();
  if (!ranges_.empty() && !sip_.echoes.empty()) publish_sonars();
  if (!bumper_ring_.empty()) publish_bumpers();
  if (has_gripper_ && sip_.ports) publish_gripper();
}

void Senses::publish_odometry() {
  const Twist2 velocity{0.5 * (sip_.left_speed + sip_.right_speed), 0.0,
                        0.5 * (sip_.right_speed - sip_.left_speed) / units_->half_track};
  odometry_.publish(pose_, velocity, stamp_);
}

void Senses::publish_sonars() {
  auto object = sonar_.loan();
  object->ranges().assign(ranges_.begin(), ranges_.end());
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    object->poses().push_back(level_frame(sonars_[i], kSonarHeight));
    object->stamps().push_back(to_time_value(stamps_[i]));
  }
  object->min_range(kShortestRange);
  object->max_range(kLongestRange);
  object->half_lobe(kHalfLobe);
  object->pose(level_pose({}, kSonarHeight, stamp_));
  set_uncertainty(*object, sonar_errors_);
  sonar_.publish(std::move(object));
}

void Senses::publish_bumpers() {
  auto object = bumpers_.loan();
  for (const Bumper& bumper : bumper_ring_) {
    const Vec2 out = direction(bumper.direction);
    object->pressed().push_back(is_pressed(bumper));
    object->names().push_back(bumper.name);
    object->poses().push_back(
        level_frame({bumper_radius_ * out.x, bumper_radius_ * out.y, bumper.direction}, 0.0));
  }
  object->stamp(to_time_value(stamp_));
  bumpers_.publish(std::move(object));
}

void Senses::publish_battery() {
  auto object = battery_.loan();
  object->name("drive");
  object->voltage(sip_.tail.real_battery_voltage.value_or(sip_.battery_voltage));
  object->current(std::nan(""));
  const std::optional<std::uint8_t>& percent = sip_.tail.state_of_charge;
  object->charge(percent ? std::min(0.01 * *percent, 1.0) : std::nan(""));
  const int charge = sip_.tail.charge_state.value_or(0);
  object->charging(charge > 0 && charge < 255);
  object->stamp(to_time_value(stamp_));
  battery_.publish(std::move(object));
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

std::vector<Obstruction::Pressed> Senses::pressed() const {
  std::vector<Obstruction::Pressed> all;
  for (const Bumper& bumper : bumper_ring_)
    if (is_pressed(bumper)) all.push_back({direction(bumper.direction), bumper.name});
  return all;
}

// The controller counts them clockwise: in front from the left to the right, behind from the right to the left.
std::vector<Senses::Bumper> Senses::named(std::vector<double> directions) {
  const auto from_the_left = [](double direction) {
    const double clockwise = 0.5 * std::numbers::pi - direction;
    return clockwise < 0.0 ? clockwise + 2.0 * std::numbers::pi : clockwise;
  };
  std::ranges::sort(directions, {}, from_the_left);
  std::vector<Bumper> all;
  unsigned front = 0;
  unsigned rear = 0;
  for (const double direction : directions) {
    const bool is_front = std::abs(direction) < 0.5 * std::numbers::pi;
    const unsigned bit = is_front ? front++ : rear++;
    all.push_back({direction, is_front, bit, (is_front ? "front " : "rear ") + std::to_string(bit + 1)});
  }
  return all;
}

bool Senses::is_pressed(const Bumper& bumper) const {
  return (((bumper.is_front ? sip_.front_bumpers : sip_.rear_bumpers) >> bumper.bit) & 1U) != 0;
}

}  // namespace orca::hw::p2os
