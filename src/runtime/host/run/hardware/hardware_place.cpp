// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hardware_place.hpp"

#include <utility>

namespace orca::host {
namespace {

bool is_at_rest(HardwareInstance* driver) {
  if (driver == nullptr) return true;
  const hw::HardwareState state = driver->container().state();
  return state == hw::HardwareState::closed || state == hw::HardwareState::fault ||
         state == hw::HardwareState::backoff;
}

}  // namespace

HardwarePlace::HardwarePlace(std::unique_ptr<HardwareInstance> driver)
    : name_(driver->name()),
      driver_(std::move(driver)),
      seat_(driver_->container(), driver_->description()) {}

HardwareInstance& HardwarePlace::add_spare(std::unique_ptr<HardwareInstance> driver) {
  const std::lock_guard lock(mutex_);
  spare_ = std::move(driver);
  return *spare_;
}

void HardwarePlace::exchange() {
  const std::lock_guard lock(mutex_);
  std::swap(driver_, spare_);
}

bool HardwarePlace::remove_spare(TimePoint deadline) {
  if (spare_ == nullptr) return true;
  if (!spare_->container().join_until(deadline)) return false;
  std::unique_ptr<HardwareInstance> gone;  // its destructor calls the plugin, so it runs without the lock
  {
    const std::lock_guard lock(mutex_);
    gone.swap(spare_);
  }
  return true;
}

void HardwarePlace::run(HardwareInstance& driver) {
  const std::lock_guard lock(mutex_);
  if (!ending_) driver.container().run();
}

void HardwarePlace::shut_down() {
  const std::lock_guard lock(mutex_);
  ending_ = true;
  driver_->container().shut_down();
  if (spare_ != nullptr) spare_->container().shut_down();
}

bool HardwarePlace::is_closed() const {
  const std::lock_guard lock(mutex_);
  return is_at_rest(driver_.get()) && is_at_rest(spare_.get());
}

bool HardwarePlace::join_until(TimePoint deadline) {
  const bool ended = driver_->container().join_until(deadline);
  return (spare_ == nullptr || spare_->container().join_until(deadline)) && ended;
}

}  // namespace orca::host
