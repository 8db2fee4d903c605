// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/seat.hpp"

#include <utility>

namespace orca::hw {
namespace {

SensorEndpoint* endpoint_of(const HardwareSeat::Sensor& wanted, const HardwareContainer& driver) {
  for (SensorEndpoint* const sensor : driver.sensors())
    if (sensor->port_stem() == wanted.port_stem && sensor->source() == wanted.source) return sensor;
  return nullptr;
}

ActuatorEndpoint* actuator_of(const HardwareSeat::Actuator& wanted, const HardwareContainer& driver) {
  for (ActuatorEndpoint* const actuator : driver.actuators())
    if (actuator->port_stem() == wanted.port_stem) return actuator;
  return nullptr;
}

}  // namespace

std::vector<HardwareSeat::Sensor> HardwareSeat::sensors() const {
  const std::lock_guard lock(mutex_);
  std::vector<Sensor> all;
  for (const SensorEndpoint* const sensor : driver_->sensors())
    all.push_back({&sensor->type(), sensor->source(), sensor->port_stem(), sensor->period()});
  return all;
}

void HardwareSeat::set_sink(const Sensor& sensor, const void* owner, SensorEndpoint::Sink sink) {
  const std::lock_guard lock(mutex_);
  std::erase_if(listeners_, [owner](const Listener& listener) { return listener.owner == owner; });
  if (sink) listeners_.push_back({sensor, owner, sink});
  if (SensorEndpoint* const endpoint = endpoint_of(sensor, *driver_))
    endpoint->set_sink(owner, std::move(sink));
}

ObjectRef HardwareSeat::latest(const Sensor& sensor) const {
  const std::lock_guard lock(mutex_);
  const SensorEndpoint* const endpoint = endpoint_of(sensor, *driver_);
  return endpoint != nullptr ? endpoint->latest() : ObjectRef{};
}

std::vector<HardwareSeat::Actuator> HardwareSeat::actuators() const {
  const std::lock_guard lock(mutex_);
  std::vector<Actuator> all;
  for (const ActuatorEndpoint* const actuator : driver_->actuators())
    all.push_back({&actuator->type(), actuator->port_stem()});
  return all;
}

Status HardwareSeat::command(const Actuator& actuator, ObjectRef command) {
  const std::lock_guard lock(mutex_);
  if (Status open = check_open(); !open.ok()) return open;
  ActuatorEndpoint* const endpoint = actuator_of(actuator, *driver_);
  if (endpoint == nullptr)
    return fail(Code::failed_precondition, "its driver has nothing that takes a " + actuator.port_stem);
  return driver_->command(*endpoint, std::move(command));
}

Status HardwareSeat::in_surroundings(const std::function<Status(Surroundings&)>& act) const {
  const std::lock_guard lock(mutex_);
  Surroundings* const world = driver_->surroundings();
  if (world == nullptr)
    return fail(Code::unimplemented,
                "its hardware is real, and only a simulated world can be seen from outside and changed; bind "
                "orca.hw.Sim or orca.hw.Emulated to it");
  if (Status open = check_open(); !open.ok()) return open;
  const HardwareState state = driver_->state();
  if (state != HardwareState::ready && state != HardwareState::active)
    return fail(Code::unavailable, "the simulated world is not there yet, or no more; its robot is " +
                                       std::string(to_string(state)));
  return act(*world);
}

std::optional<DriveLimits> HardwareSeat::limits() const {
  const std::lock_guard lock(mutex_);
  return driver_->motion() != nullptr ? std::optional(driver_->motion()->limits()) : std::nullopt;
}

Duration HardwareSeat::max_command_age() const {
  const std::lock_guard lock(mutex_);
  return driver_->motion()->max_command_age();
}

std::optional<std::string> HardwareSeat::take_hindrance(Hindrance by) const {
  const std::lock_guard lock(mutex_);
  return pause_ ? std::nullopt : driver_->motion()->take_hindrance(by);
}

bool HardwareSeat::has_line() const {
  const std::lock_guard lock(mutex_);
  return !driver_->line_name().empty();
}

bool HardwareSeat::moves() const {
  const std::lock_guard lock(mutex_);
  return driver_->motion() != nullptr || !driver_->actuators().empty();
}

idl::DeviceStatistics HardwareSeat::statistics() const {
  const std::lock_guard lock(mutex_);
  return driver_->statistics();
}

idl::Robot HardwareSeat::description() const {
  const std::lock_guard lock(mutex_);
  if (!description_) description_ = driver_->description();
  return *description_;
}

void HardwareSeat::acquire() {
  const std::lock_guard lock(mutex_);
  ++users_;
  if (!pause_) driver_->acquire();
}

void HardwareSeat::release() {
  const std::lock_guard lock(mutex_);
  --users_;
  if (!pause_) driver_->release();
}

bool HardwareSeat::is_used() const {
  const std::lock_guard lock(mutex_);
  return users_ > 0;
}

HardwareState HardwareSeat::state() const {
  const std::lock_guard lock(mutex_);
  return pause_ ? pause_->state : driver_->state();
}

std::string HardwareSeat::fault() const {
  const std::lock_guard lock(mutex_);
  return pause_ ? pause_->reason : driver_->fault();
}

bool HardwareSeat::is_lost() const {
  const std::lock_guard lock(mutex_);
  return pause_ ? pause_->state == HardwareState::fault : driver_->is_lost();
}

void HardwareSeat::watch(Strand& strand, bool on) {
  const std::lock_guard lock(mutex_);
  std::erase(watchers_, &strand);
  if (on) watchers_.push_back(&strand);
  driver_->watch(strand, on);
}

void HardwareSeat::hold(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  held_ = reason;
  if (!pause_) driver_->hold(reason);
}

bool HardwareSeat::let_go() {
  const std::lock_guard lock(mutex_);
  const bool was_held = std::exchange(held_, std::nullopt).has_value();
  return (!pause_ && driver_->let_go()) || was_held;
}

void HardwareSeat::pause(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  pause_ = {driver_->state(), reason};
  driver_->hold(reason);
  for (int user = 0; user < users_; ++user) driver_->release();
}

void HardwareSeat::resume(HardwareContainer& driver, const idl::Robot& description) {
  const std::lock_guard lock(mutex_);
  pause_.reset();
  if (&driver != driver_) take_over(driver);
  description_ = description;
  (void)driver.let_go();
  if (held_) driver.hold(*held_);
  for (int user = 0; user < users_; ++user) driver.acquire();
  wake_watchers();
}

void HardwareSeat::give_up(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  pause_ = {HardwareState::fault, reason};
  wake_watchers();
}

Status HardwareSeat::check_open() const {
  if (pause_) return fail(Code::unavailable, "the base is held: " + pause_->reason);
  return ok();
}

void HardwareSeat::take_over(HardwareContainer& driver) {
  for (const Listener& listener : listeners_) {
    if (SensorEndpoint* const old = endpoint_of(listener.sensor, *driver_))
      old->set_sink(listener.owner, nullptr);
    if (SensorEndpoint* const endpoint = endpoint_of(listener.sensor, driver))
      endpoint->set_sink(listener.owner, listener.sink);
  }
  for (Strand* const watcher : watchers_) {
    driver_->watch(*watcher, false);
    driver.watch(*watcher);
  }
  driver_ = &driver;
}

void HardwareSeat::wake_watchers() const {
  for (Strand* const watcher : watchers_) watcher->wake();
}

}  // namespace orca::hw
