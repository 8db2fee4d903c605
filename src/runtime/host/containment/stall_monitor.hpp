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

/// A thread that watches an executive from outside. A component that computes for 2 s of CPU time, or sleeps
/// in the system for 2 s, without waiting for anything of Orca is reported: as a standstill if it holds up
/// all others, else in an alarm STALLED, once per component.
///
/// Thread contract: lives around Executive::run().
class StallMonitor {
 public:
  /// Called in a standstill, with the component and what is wrong. Nothing else can run: it must end the
  /// process.
  using Standstill = std::function<void(const std::string& component, const std::string& text)>;

  /// @param sink, standstill  called by a thread of the monitor's own.
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
