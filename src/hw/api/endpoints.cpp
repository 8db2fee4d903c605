// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/endpoints.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orca/base/portable_math.hpp"

namespace orca::hw {

std::string SensorEndpoint::port_stem() const {
  const std::string type(type_.name);
  return device_.empty() ? type : device_ + "_" + type;
}

void SensorEndpoint::set_sink(const void* owner, Sink sink) {
  const std::lock_guard lock(mutex_);
  std::erase_if(sinks_, [owner](const auto& entry) { return entry.first == owner; });
  if (sink) sinks_.emplace_back(owner, std::move(sink));
}

ObjectRef SensorEndpoint::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

void SensorEndpoint::forget() {
  const std::lock_guard lock(mutex_);
  latest_ = ObjectRef{};
}

void SensorEndpoint::publish_loan(ObjectLoan reading) {
  const std::lock_guard lock(mutex_);
  latest_ = sinks_.empty() ? std::move(reading).seal() : sinks_.front().second(std::move(reading));
  for (std::size_t i = 1; i < sinks_.size(); ++i) sinks_[i].second(copy_value(latest_));
}

Twist2 twist_of(const idl::MotionCommand& command, const DriveLimits& limits) {
  if (command.kind() == idl::FULLSTOP) return {};
  const auto turning = [&](double rate) {
    return std::clamp(rate, -limits.max_turn_rate, limits.max_turn_rate);
  };
  Twist2 twist;
  twist.forward = std::clamp(command.speed(), -limits.max_speed, limits.max_speed);
  if (command.steering() == idl::BY_TURN_RATE) {
    twist.turn_rate = turning(command.turn_rate());
    return twist;
  }
  twist.turn_rate = turning(limits.steer_gain * command.direction());
  if (limits.big_turn_angle > 0.0 && std::abs(command.direction()) > limits.big_turn_angle)
    twist.forward = std::clamp(twist.forward, -limits.big_turn_speed, limits.big_turn_speed);
  return twist;
}

Twist2 twist_of(const idl::HolonomicVelocity& velocity, const DriveLimits& limits) {
  if (velocity.kind() == idl::FULLSTOP) return {};
  const double speed = portable::hypot(velocity.speed(), velocity.left());
  const double share = speed > limits.max_speed ? limits.max_speed / speed : 1.0;
  return {share * velocity.speed(), share * velocity.left(),
          std::clamp(velocity.turn_rate(), -limits.max_turn_rate, limits.max_turn_rate)};
}

MotionHW::MotionHW(const DriveLimits& limits, Duration max_command_age)
    : limits_(limits), max_command_age_(max_command_age) {}

Status MotionHW::check(const idl::MotionCommand& command) {
  if (command.kind() == idl::DONTCARE)
    return fail(Code::invalid_argument,
                "a base needs a crisp motion command, not DONTCARE; put a MotionCommandFuser in front of it");
  return check_command(command);
}

Status MotionHW::command(const idl::MotionCommand& command, TimePoint now) {
  if (Status checked = check(command); !checked.ok()) return checked;
  return move({.velocity = twist_of(command, limits_), .at_once = command.kind() == idl::FULLSTOP},
              command.mission(), now);
}

Status MotionHW::command(const idl::HolonomicVelocity& velocity, TimePoint now) {
  if (limits_.type != idl::HOLONOMIC) return fail(Code::failed_precondition, kNotSideways);
  if (Status checked = check(velocity); !checked.ok()) return checked;
  if (Status checked = check_command(velocity); !checked.ok()) return checked;
  return move({.velocity = twist_of(velocity, limits_), .at_once = velocity.kind() == idl::FULLSTOP},
              velocity.mission(), now);
}

Status MotionHW::move(const DriveSetpoint& wanted, std::uint64_t mission, TimePoint now) {
  const std::lock_guard lock(mutex_);
  mission_ = mission;
  if (Status free = check_held(); !free.ok() && wanted.velocity != Twist2{}) return free;
  if (const auto reason = obstruction_.against(wanted.velocity)) {
    stand();
    return fail(Code::unavailable, "the base stands: " + *reason + "; ask for another direction");
  }
  setpoint_.velocity = wanted.velocity;
  setpoint_.at_once = wanted.at_once;
  received_ = now;
  return ok();
}

void MotionHW::obstruct(const std::string& reason, Hindrance by) {
  const std::lock_guard lock(mutex_);
  obstruction_.meet(setpoint_.velocity, reason, by);
  stand();
}

void MotionHW::press(const std::vector<Obstruction::Pressed>& bumpers) {
  const std::lock_guard lock(mutex_);
  obstruction_.press(bumpers);
  const auto reason = obstruction_.against(setpoint_.velocity);
  if (!reason) return;
  obstruction_.meet(setpoint_.velocity, *reason);
  stand();
}

std::optional<std::string> MotionHW::take_hindrance(Hindrance by) {
  const std::lock_guard lock(mutex_);
  return obstruction_.take_hindrance(by);
}

// @pre  mutex_ is held.
void MotionHW::stand() { setpoint_ = setpoint_.stopped(); }

DriveSetpoint MotionHW::due(TimePoint now) {
  const std::lock_guard lock(mutex_);
  if (!setpoint_.stands() && now >= received_ + max_command_age_) {
    ++expired_;
    stand();
  }
  return setpoint_;
}

void MotionHW::halt() {
  const std::lock_guard lock(mutex_);
  stand();
}

void MotionHW::hold(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  held_ = own_hold_ = reason;
  stand();
}

void MotionHW::hold_by_order(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  held_ = reason;
  stand();
}

std::optional<std::string> MotionHW::own_hold() const {
  const std::lock_guard lock(mutex_);
  return own_hold_;
}

bool MotionHW::let_go() {
  const std::lock_guard lock(mutex_);
  own_hold_.reset();
  return std::exchange(held_, std::nullopt).has_value();
}

// @pre  mutex_ is held.
Status MotionHW::check_held() const {
  return held_ ? Status(fail(Code::unavailable, "the base is held: " + *held_)) : ok();
}

void MotionHW::end_mission() {
  const std::lock_guard lock(mutex_);
  mission_ = 0;
}

std::uint64_t MotionHW::mission() const {
  const std::lock_guard lock(mutex_);
  return mission_;
}

TimePoint MotionHW::expiry() const {
  const std::lock_guard lock(mutex_);
  return setpoint_.stands() ? kForever : received_ + max_command_age_;
}

TimePoint MotionHW::last_command() const {
  const std::lock_guard lock(mutex_);
  return received_;
}

std::uint64_t MotionHW::expired_count() const {
  const std::lock_guard lock(mutex_);
  return expired_;
}

}  // namespace orca::hw
