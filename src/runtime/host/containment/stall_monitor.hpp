// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

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
/// others, the report is a standstill, otherwise an alarm STALLED, once per component.
///
/// Thread contract: lives around Executive::run().
class StallMonitor {
 public:
  /// A handler of a standstill, called with the component and what is wrong. It must end the process, because
  /// nothing else can run.
  using Standstill = std::function<void(const std::string& component, const std::string& text)>;

  /// @param sink, standstill  called by the monitor's own thread.
  StallMonitor(Executive& executive, AlarmSink sink, Standstill standstill);
  ~StallMonitor();
  StallMonitor(const StallMonitor&) = delete;
  StallMonitor& operator=(const StallMonitor&) = delete;

 private:
  void watch();

  Executive& executive_;
  const AlarmSink sink_;
  const Standstill standstill_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool ending_ = false;
  std::set<std::string> said_;
  std::thread watcher_;
};

}  // namespace orca::host
