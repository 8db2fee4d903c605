// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/container.hpp"

#include <algorithm>
#include <exception>
#include <typeinfo>
#include <utility>

#include "orca/base/activity.hpp"
#include "orca/base/exception_text.hpp"

namespace orca::hw {

void HardwareContainer::run() {
  strand_ = std::make_unique<Strand>(host_.executive(), TaskOptions{host_.name(), 1});
  set_state(HardwareState::opening);
  strand_->start([this] { main(); });
}

void HardwareContainer::shut_down() {
  shutting_down_.store(true, std::memory_order_release);
  if (strand_ != nullptr) strand_->wake();
}

void HardwareContainer::acquire() {
  users_.fetch_add(1);
  if (strand_ != nullptr) strand_->wake();
}

void HardwareContainer::release() {
  users_.fetch_sub(1);
  if (strand_ != nullptr) strand_->wake();
}

Status HardwareContainer::check_active() const {
  if (motion_ == nullptr) return fail(Code::failed_precondition, host_.name() + " has nothing that moves");
  if (state() != HardwareState::active)
    return fail(Code::unavailable,
                host_.name() + " is " + to_string(state()) + ", not Active: nobody has started it");
  return ok();
}

std::string HardwareContainer::fault() const {
  const std::lock_guard lock(mutex_);
  return fault_;
}

void HardwareContainer::watch(Strand& strand) {
  const std::lock_guard lock(mutex_);
  watchers_.push_back(&strand);
}

void HardwareContainer::set_state(HardwareState state) {
  state_.store(state, std::memory_order_release);
  host_.state_changed(state);
  const std::lock_guard lock(mutex_);
  for (Strand* watcher : watchers_) watcher->wake();
}

void HardwareContainer::fail_with(const std::string& reason) {
  if (state() == HardwareState::fault) return;  // what went wrong first is the reason that people need
  {
    const std::lock_guard lock(mutex_);
    fault_ = reason;
  }
  host_.write_log(log::Level::error, reason);
  if (motion_ != nullptr) motion_->halt();
  if (state() == HardwareState::active) still_stop();
  for (SensorEndpoint* sensor : sensors_) sensor->forget();
  set_state(HardwareState::fault);
}

// The device has failed in some way, but its motors may run and may still listen.
void HardwareContainer::still_stop() {
  try {
    applied_ = DriveSetpoint{.turret_angle = applied_.turret_angle};
    if (motion_ != nullptr && !drive(applied_).ok())
      host_.write_log(log::Level::error, "the motors did not take the stop command either");
    stop();
  } catch (...) {
    host_.write_log(log::Level::error, "the hardware plugin threw while it was stopped after a fault");
  }
}

void HardwareContainer::guarded(void (HardwareContainer::*step)()) {
  try {
    (this->*step)();
  } catch (...) {
    fail_with("the hardware plugin " + describe_current_exception());
  }
}

void HardwareContainer::main() {
  const Activity activity(host_.name().c_str(), "its strand", &typeid(*this));
  guarded(&HardwareContainer::open_device);
  while (!shutting_down_.load(std::memory_order_acquire)) guarded(&HardwareContainer::turn);
  users_.store(0);
  guarded(&HardwareContainer::follow_users);
  guarded(&HardwareContainer::close);
  if (state() != HardwareState::fault) set_state(HardwareState::closed);
}

void HardwareContainer::open_device() {
  const Status opened = open();
  if (opened.ok()) {
    set_state(HardwareState::ready);
  } else {
    fail_with(opened.error().text());
  }
}

void HardwareContainer::turn() {
  follow_users();
  apply_motion();
  if (works() && host_.now() >= next_poll())
    if (const Status polled = poll(); !polled.ok()) fail_with(polled.error().text());
  strand_->pause_until(next_turn());
}

bool HardwareContainer::works() const {
  const HardwareState now = state();
  return now == HardwareState::ready || now == HardwareState::active;
}

TimePoint HardwareContainer::next_turn() const {
  if (!works()) return kForever;
  const bool moves = state() == HardwareState::active && motion_ != nullptr;
  return moves ? std::min(next_poll(), motion_->expiry()) : next_poll();
}

void HardwareContainer::follow_users() {
  const bool wanted = users_.load() > 0;
  if (wanted && state() == HardwareState::ready) start_device();
  if (!wanted && state() == HardwareState::active) stop_device();
}

void HardwareContainer::start_device() {
  if (motion_ != nullptr) motion_->halt();  // a command of an earlier use must not move it now
  if (const Status started = start(); !started.ok()) {
    fail_with(started.error().text());
  } else {
    set_state(HardwareState::active);
  }
}

void HardwareContainer::stop_device() {
  if (motion_ != nullptr) motion_->halt();
  drive_to({.turret_angle = applied_.turret_angle});
  if (state() != HardwareState::active) return;
  stop();
  for (SensorEndpoint* sensor : sensors_) sensor->forget();
  set_state(HardwareState::ready);
}

void HardwareContainer::apply_motion() {
  if (motion_ != nullptr && state() == HardwareState::active) drive_to(motion_->due(host_.now()));
}

void HardwareContainer::drive_to(const DriveSetpoint& setpoint) {
  if (setpoint == applied_) return;
  applied_ = setpoint;
  if (const Status driven = drive(setpoint); !driven.ok()) fail_with(driven.error().text());
}

}  // namespace orca::hw
