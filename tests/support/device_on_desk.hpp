// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "deployer.hpp"
#include "desk.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/hw/link/pty_link.hpp"

namespace orca::test {

/// A device on a desk in real time: its line, a pseudo terminal, is there, and its firmware runs, as long as this lives.
///
/// Thread contract: one thread.
template <class Firmware, class Body>
class DeviceOnDesk {
 public:
  /// @param more  what the firmware's constructor takes behind the body.
  template <class... More>
  explicit DeviceOnDesk(const DeskLine& line, More&&... more)
      : DeviceOnDesk(std::make_unique<hw::link::PtyLink>(line.device), line.faults,
                     std::forward<More>(more)...) {}

  ~DeviceOnDesk() {
    ends_ = true;
    thread_.join();
  }
  DeviceOnDesk(const DeviceOnDesk&) = delete;
  DeviceOnDesk& operator=(const DeviceOnDesk&) = delete;

  /// Looks at firmware and body, or changes them, between two of their steps.
  template <class Look>
  auto with(Look look) {
    const std::lock_guard lock(mutex_);
    return desk_.with(look);
  }
  /// Pulls the plug out, and puts it in again.
  void unplug() {
    const std::lock_guard lock(mutex_);
    desk_.close();
  }
  void plug_in() {
    const std::lock_guard lock(mutex_);
    open();
  }
  /// As those of Desk.
  void fall_silent(bool silent) { desk_.fall_silent(silent); }
  void echo(bool echoes) { desk_.echo(echoes); }
  [[nodiscard]] std::uint64_t faults(hw::link::Fault fault) const { return desk_.faults(fault); }

 private:
  template <class... More>
  DeviceOnDesk(std::unique_ptr<hw::link::PtyLink> pty, std::optional<hw::link::FaultPlan> plan,
               More&&... more)
      : pty_(*pty), desk_(std::move(pty), on_this_clock(std::move(plan)), std::forward<More>(more)...) {
    open();
    thread_ = std::thread([this] { run(); });
  }

  static std::optional<hw::link::FaultPlan> on_this_clock(std::optional<hw::link::FaultPlan> plan) {
    if (plan) plan->now = steady_now;
    return plan;
  }

  // A line with faults would not outlive the driver's first leave.
  void open() {
    desk_.open();
    if (!desk_.has_faults()) REQUIRE(pty_.await_driver().ok());
  }

  void run() {
    for (; !ends_; std::this_thread::sleep_for(1ms)) {
      const std::lock_guard lock(mutex_);
      desk_.go_on(steady_now(), pty_.line() ? pty_.line()->baud : 0);
    }
  }

  hw::link::PtyLink& pty_;  // inside desk_
  Desk<Firmware, Body> desk_;
  std::mutex mutex_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

/// Returns whether the condition comes true within 20 s.
inline bool eventually(const std::function<bool()>& condition) {
  const TimePoint end = steady_now() + 20s * static_cast<int>(kSlowdown);
  while (!condition()) {
    if (steady_now() > end) return false;
    std::this_thread::sleep_for(5ms);
  }
  return true;
}

}  // namespace orca::test
