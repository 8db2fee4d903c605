// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "orca/base/executive.hpp"

namespace orca::host {

/// Watches an executive from outside. A component that computes for 2 s of CPU time, or sleeps in the system
/// for 2 s, without waiting for anything of Orca is named: where it holds up all others, in an error that
/// ends the process; where it has a thread of its own, in an alarm STALLED, once per component.
///
/// Thread contract: lives around Executive::run().
class StallMonitor {
 public:
  explicit StallMonitor(Executive& executive);
  ~StallMonitor();
  StallMonitor(const StallMonitor&) = delete;
  StallMonitor& operator=(const StallMonitor&) = delete;

 private:
  void watch();
  [[noreturn]] static void end_process(const StuckTask& stuck);

  Executive& executive_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool ending_ = false;
  std::set<std::string> said_;
  std::thread watcher_;
};

}  // namespace orca::host
