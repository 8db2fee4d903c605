// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/container.hpp"

#include <algorithm>
#include <exception>
#include <utility>

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

Status HardwareContainer::command(const idl::MotionCommand& command) {
  if (motion_ == nullptr) return fail(Code::failed_precondition, host_.name() + " has nothing that moves");
  if (state() != HardwareState::active)
    return fail(Code::unavailable,
                host_.name() + " is " + to_string(state()) + ", not Active: nobody has started it");
  const Status taken = motion_->command(command, host_.now());
  if (taken.ok()) strand_->wake();
  return taken;
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
  {
    const std::lock_guard lock(mutex_);
    fault_ = reason;
  }
  host_.write_log(log::Level::error, reason);
  if (motion_ != nullptr) motion_->halt();
  set_state(HardwareState::fault);
}

void HardwareContainer::main() {
  try {
    open_device();
    while (!shutting_down_.load(std::memory_order_acquire)) turn();
    if (state() == HardwareState::active) {
      users_.store(0);
      follow_users();
    }
    close();
    if (state() != HardwareState::fault) set_state(HardwareState::closed);
  } catch (const std::exception& error) {
    fail_with("the hardware plugin threw: " + std::string(error.what()));
  } catch (...) {
    fail_with("the hardware plugin threw something that is not a std::exception");
  }
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
  if (state() == HardwareState::fault) {
    strand_->pause_until(kForever);
    return;
  }
  follow_users();
  apply_motion();
  if (host_.now() >= next_poll()) {
    if (const Status polled = poll(); !polled.ok()) {
      fail_with(polled.error().text());
      return;
    }
  }
  const TimePoint expiry =
      state() == HardwareState::active && motion_ != nullptr ? motion_->expiry() : kForever;
  strand_->pause_until(std::min(next_poll(), expiry));
}

void HardwareContainer::follow_users() {
  const bool wanted = users_.load() > 0;
  if (wanted && state() == HardwareState::ready) {
    if (const Status started = start(); !started.ok()) {
      fail_with(started.error().text());
    } else {
      set_state(HardwareState::active);
    }
  } else if (!wanted && state() == HardwareState::active) {
    if (motion_ != nullptr) motion_->halt();
    apply_motion();
    stop();
    for (SensorEndpoint* sensor : sensors_) sensor->forget();
    set_state(HardwareState::ready);
  }
}

void HardwareContainer::apply_motion() {
  if (motion_ == nullptr || state() != HardwareState::active) return;
  const DriveSetpoint setpoint = motion_->due(host_.now());
  if (setpoint == applied_) return;
  applied_ = setpoint;
  if (const Status driven = drive(setpoint); !driven.ok()) fail_with(driven.error().text());
}

}  // namespace orca::hw
