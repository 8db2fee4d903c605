// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "orca/base/executive.hpp"

namespace orca {

/// Watches a cooperative executive from outside: a component that computes for 2 s of CPU time without
/// waiting for anything holds up all others, cannot be stopped, and is therefore named in an error that ends
/// the process.
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

  Executive& executive_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool ending_ = false;
  std::thread watcher_;
};

}  // namespace orca
