// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "hardware_lifecycle.hpp"
#include "orca/base/strand.hpp"
#include "orca/hw/container.hpp"

namespace orca::hw {

/// The running part of one hardware container: its strand and its users. It polls the device and carries out
/// commands. Nothing that the driver throws passes beyond it.
///
/// Thread contract: the public functions from any strand.
class HardwareLoop {
 public:
  /// @param container  outlives this object; its functions are called on the strand only.
  HardwareLoop(HardwareContainer& container, HardwareHost& host);
  HardwareLoop(const HardwareLoop&) = delete;
  HardwareLoop& operator=(const HardwareLoop&) = delete;

  /// Starts the strand, which opens the device; again if it was shut down and has ended.
  void run();
  /// Makes the strand stop and close the device and then end.
  void shut_down();
  [[nodiscard]] bool join_until(TimePoint deadline);

  /// Adds or removes a user.
  void acquire();
  void release();
  /// Makes the strand carry out a new command at once.
  void wake();

  [[nodiscard]] HardwareLifecycle& life() { return life_; }

 private:
  void main();
  void turn();
  void guarded(const std::function<void()>& step);
  void apply_motion();
  void report_expiry(const MotionHW& motion);
  [[nodiscard]] bool works() const;
  [[nodiscard]] TimePoint next_turn() const;

  HardwareContainer& container_;
  HardwareHost& host_;
  HardwareLifecycle life_;
  std::optional<Strand> strand_;
  TimePoint next_expiry_report_{};
  std::atomic<int> users_{0};
  std::atomic<bool> shutting_down_{false};
};

}  // namespace orca::hw
