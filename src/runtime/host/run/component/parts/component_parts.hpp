// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "component_settings.hpp"
#include "containment/guard.hpp"
#include "failure_injector.hpp"
#include "hook_caller.hpp"
#include "lap_meter.hpp"
#include "lap_trigger.hpp"
#include "orca/base/random.hpp"
#include "orca/base/strand.hpp"
#include "orca/base/system/recent_times.hpp"
#include "orca/component/device.hpp"
#include "order_queue.hpp"
#include "parameters.hpp"
#include "peer_orders.hpp"
#include "port_set.hpp"
#include "run/reporting/line_limit.hpp"
#include "run/reporting/run_context.hpp"

namespace orca::host {

/// The parts of one component in this process, apart from its code. Each part has its own thread contract.
struct ComponentParts {
  /// @param device  the hardware that the graph binds to the component, or null.
  ComponentParts(RunContext& run_of_all, ComponentSettings settings_of_this, Device* device);
  ComponentParts(const ComponentParts&) = delete;
  ComponentParts& operator=(const ComponentParts&) = delete;

  [[nodiscard]] TimePoint now() const { return run.executive.now(); }
  /// Returns how long computing the next lap takes [s]: in virtual time what the graph says, so many times as the run says; in
  /// real time nothing, because the machine computes then.
  [[nodiscard]] Duration lap_time() {
    if (settings.takes.quantiles.empty() || !run.executive.is_virtual()) return Duration{0};
    return from_seconds(run.computing * settings.takes.at(lap_shares.uniform(0.0, 1.0)));
  }
  /// Writes a line to the log. It names the mission at which the component works, if there is one. To be called on its
  /// strand.
  void write_log(log::Level level, std::string_view text) const;
  /// Reports a failure of the component: writes a line to the log, and raises an alarm with the mission and
  /// cause of what the component works on. To be called on its strand.
  /// @param port  port of a handler; "" for other hooks.
  void report_failure(Hook hook, const std::string& text, const char* port = "");
  /// Writes to the log that a handler refused an object: the same refusal over and over at most once in 10 s. To be called on its strand.
  void report_refusal(const std::string& text);
  /// Raise or clear an alarm of the component's own; what changes nothing does nothing. To be called on its strand.
  void raise_alarm(const std::string& kind, idl::AlarmSeverity severity, const std::string& text);
  void clear_alarm(const std::string& kind, const std::string& text);

  RunContext& run;
  const ComponentSettings settings;
  Device* const hardware;
  Strand strand;
  PortHome home;
  PortSet ports;
  LapTrigger laps;
  RandomStream lap_shares;          // which of the laps that were measured the next one is like
  std::unique_ptr<LapMeter> meter;  // of the processor time of laps, if the run measures them
  /// Of the processor time of laps; null in virtual time, and where strands share a thread, which has one clock.
  const std::unique_ptr<RecentTimes> recent_laps;
  HookCaller hooks;
  FailureInjector injector;
  Parameters params;
  OrderQueue orders;
  const std::unique_ptr<PeerOrders> peer_orders = std::make_unique<PeerOrders>();
  std::map<std::string, idl::Alarm> own_alarms;  // the last of each kind
  std::string last_refusal;                      // by a handler
  std::optional<LineLimit> refusal_lines;        // of that one
};

}  // namespace orca::host
