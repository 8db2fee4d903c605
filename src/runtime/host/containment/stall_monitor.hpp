// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "orca/base/executive.hpp"
#include "orca/host/alarm.hpp"

namespace orca::host {

/// A thread that watches an executive from outside. It reports a component that computes for 2 s of CPU time,
/// or sleeps in the system for 2 s, without waiting for anything of Orca. If the component holds up all
/// others, the report is a standstill, otherwise an alarm STALLED, once per component. While a hang limit is set, it takes
/// the place of the 2 s, and each such component is a standstill.
///
/// Thread contract: lives around Executive::run().
class StallMonitor {
 public:
  /// A handler of a standstill, called with the component and what is wrong. It must end the process, because
  /// nothing else can run.
  using Standstill = std::function<void(const std::string& component, const std::string& text)>;

  /// @param sink, standstill  called by the monitor's own thread.
  /// @param hang_limit  [s] may change at any time; 0: there is none. Outlives the monitor.
  StallMonitor(Executive& executive, AlarmSink sink, Standstill standstill,
               const std::atomic<Duration>& hang_limit);
  ~StallMonitor();
  StallMonitor(const StallMonitor&) = delete;
  StallMonitor& operator=(const StallMonitor&) = delete;

 private:
  void watch();
  void look(Duration hang_limit);

  Executive& executive_;
  const AlarmSink sink_;
  const Standstill standstill_;
  const std::atomic<Duration>& hang_limit_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool ending_ = false;
  std::set<std::string> said_;
  std::thread watcher_;
};

}  // namespace orca::host
