// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "hardware_lifecycle.hpp"
#include "line_record.hpp"
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
  /// Notes that the device lives. On the strand.
  void heard() { last_heard_ = host_.now(); }

  [[nodiscard]] HardwareLifecycle& life() { return life_; }
  [[nodiscard]] LineRecord& record() { return record_; }

 private:
  void main();
  void turn();
  void open();
  void attend();
  void poll();
  void reopen();
  void check_silence();
  void guarded(const std::function<void()>& step);
  void apply_motion();
  void report_expiry(const MotionHW& motion);
  void report_hold();
  [[nodiscard]] bool is_open() const;
  [[nodiscard]] bool works() const;
  [[nodiscard]] TimePoint silence_ends() const;
  [[nodiscard]] TimePoint next_turn() const;

  HardwareContainer& container_;
  HardwareHost& host_;
  HardwareLifecycle life_;
  LineRecord record_;
  std::optional<Strand> strand_;
  bool hears_input_ = false;  // the strand is woken by input
  TimePoint last_heard_{};
  TimePoint opened_{};
  Duration pause_{};  // before it is opened again, the next time
  std::optional<TimePoint> retry_at_;
  TimePoint next_expiry_report_{};
  std::optional<std::string> told_hold_;  // as it was reported
  std::optional<TimePoint> expired_at_;   // a command, and none has come since
  std::atomic<int> users_{0};
  std::atomic<bool> shutting_down_{false};
};

}  // namespace orca::hw
