// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hardware_states.hpp"
#include "orca/base/strand.hpp"
#include "orca/hw/container.hpp"

namespace orca::hw {

/// The state of one hardware container. It looks an event up in the table of hardware_states.hpp, carries out
/// the actions, and keeps the reason why the container failed.
///
/// Thread contract: state(), fault(), watch() and unwatch() from any strand; the rest on the container's strand, or
/// before that strand starts.
class HardwareLifecycle {
 public:
  /// @param container  outlives this object.
  HardwareLifecycle(HardwareContainer& container, HardwareHost& host) : container_(container), host_(host) {}
  HardwareLifecycle(const HardwareLifecycle&) = delete;
  HardwareLifecycle& operator=(const HardwareLifecycle&) = delete;

  /// Takes an event, and the events that its actions end in. Passes on what the driver throws.
  void handle(HardwareEvent event);
  /// Reports a fault and takes the event `failed`.
  void fail_with(const std::string& reason);
  /// Gives the motors a set-point, unless they already have it. An error of the driver is a fault.
  void drive(const DriveSetpoint& setpoint);

  [[nodiscard]] HardwareState state() const { return state_.load(std::memory_order_acquire); }
  /// Returns why the state is Fault.
  [[nodiscard]] std::string fault() const;
  /// Wakes `strand` at every change of state.
  void watch(Strand& strand);
  /// Forgets `strand`, which is not woken once this has returned.
  void unwatch(const Strand& strand);

 private:
  using FollowUp = std::optional<HardwareEvent>;  // the event that an action ended in

  FollowUp carry_out(const HardwareTransition& transition);
  FollowUp carry_out(HardwareAction action, HardwareState to);
  void enter(HardwareState state);
  void halt(HardwareState to);
  void forget();
  void try_stop();
  Status drive_to(const DriveSetpoint& setpoint);
  FollowUp checked(const Status& outcome);
  void report(const std::string& reason);

  HardwareContainer& container_;
  HardwareHost& host_;
  DriveSetpoint applied_;
  std::atomic<HardwareState> state_{HardwareState::closed};
  mutable std::mutex mutex_;
  std::string fault_;
  std::vector<Strand*> watchers_;
};

}  // namespace orca::hw
