// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "lifecycle.hpp"
#include "parts/component_parts.hpp"
#include "parts/residency.hpp"

namespace orca::host {

/// The body of one component's strand. It checks the component's circumstances, turns them into events for
/// the state machine, and calls laps and handlers between them.
///
/// Thread contract: open_gate(), announce_exit() and request_exit() from anywhere, the rest on the strand.
class ComponentLoop {
 public:
  /// Makes the strand ask this object whether a wait is to be given up.
  ComponentLoop(ComponentParts& parts, Residency& residency, Lifecycle& life, StateKeeper& keeper);
  ComponentLoop(const ComponentLoop&) = delete;
  ComponentLoop& operator=(const ComponentLoop&) = delete;

  /// Runs until request_exit().
  void run();
  /// Looks after the deadlines of the ports from now on, if one has some. @thread  the strand.
  void watch_deadlines();
  /// Lets the component leave IDLE: the whole system is up.
  void open_gate();
  /// Announces request_exit(). The component ends its present hook or lap and begins nothing new.
  void announce_exit();
  /// Ends the loop at the next wait or lap boundary.
  /// @param keeps_state  whether the state is handed out then, whatever the graph says.
  void request_exit(bool keeps_state);

 private:
  void turn();
  void restore_early();
  [[nodiscard]] std::optional<ComponentEvent> look() const;
  void lap();
  [[nodiscard]] bool computes_to_end(Duration time);
  void conclude(const Outcome& outcome);
  bool handle_one_intake();
  bool handle_sent(SendServerEndpoint& endpoint);
  bool handle_asked(QueryServerEndpoint& endpoint);
  void contain(const Endpoint& endpoint, const std::optional<PluginFault>& fault);

  [[nodiscard]] bool asked_for() const;
  [[nodiscard]] bool wanted() const;
  [[nodiscard]] bool must_leave_lap() const;
  [[nodiscard]] bool is_open() const { return gate_open_.load(std::memory_order_acquire); }
  [[nodiscard]] bool is_to_exit() const { return exit_requested_.load(std::memory_order_acquire); }
  [[nodiscard]] TimePoint unload_time() const;
  [[nodiscard]] TimePoint keeping_time() const;
  [[nodiscard]] TimePoint next_wake_up() const;

  ComponentParts& parts_;
  Residency& residency_;
  Lifecycle& life_;
  StateKeeper& keeper_;
  bool in_lap_ = false;
  std::uint64_t activity_before_lap_ = 0;
  TimePoint last_intake_{};
  std::atomic<bool> gate_open_{false};
  std::atomic<bool> keeps_last_state_{false};
  std::atomic<bool> exit_requested_{false};
};

}  // namespace orca::host
