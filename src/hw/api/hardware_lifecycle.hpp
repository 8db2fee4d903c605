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
  /// Takes the event `failed` and reports why, or `failed_again` if that is known.
  void fail_with(const std::string& reason);
  /// Asks the driver once more whether it knows what is there.
  void probe_again();
  /// Gives the motors a set-point, unless they already have it. An error of the driver is a fault.
  void drive(const DriveSetpoint& setpoint);
  /// Lets the actuators do what was asked of them. An error is a fault.
  void act();

  [[nodiscard]] HardwareState state() const { return state_.load(std::memory_order_acquire); }
  /// Returns why the device has failed.
  [[nodiscard]] std::string fault() const;
  /// Returns whether the device has failed for good.
  [[nodiscard]] bool is_lost() const { return state() == HardwareState::fault && !reopens(); }
  /// Returns whether the device, if it fails, is opened again: it has worked since the strand began.
  [[nodiscard]] bool reopens() const { return reopens_.load(std::memory_order_acquire); }
  /// Wakes `strand` at every change of state.
  void watch(Strand& strand);
  /// Forgets `strand`, which is not woken once this has returned.
  void unwatch(const Strand& strand);

 private:
  using FollowUp = std::optional<HardwareEvent>;  // the event that an action ended in

  FollowUp carry_out(const HardwareTransition& transition);
  FollowUp carry_out(HardwareAction action, HardwareState to);
  void enter(HardwareState state);
  void note_work();
  void halt(HardwareState to);
  void forget();
  void try_stop();
  Status drive_to(const DriveSetpoint& setpoint);
  FollowUp probe();
  FollowUp checked(const Status& outcome);
  HardwareEvent failure(const std::string& reason);
  void report(const std::string& reason);

  HardwareContainer& container_;
  HardwareHost& host_;
  DriveSetpoint applied_;
  bool works_ = false;  // it was ready after the last fault
  std::atomic<bool> reopens_{false};
  std::atomic<HardwareState> state_{HardwareState::closed};
  mutable std::mutex mutex_;
  std::string fault_;
  std::vector<Strand*> watchers_;
};

}  // namespace orca::hw
