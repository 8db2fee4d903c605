// SPDX-License-Identifier: LGPL-3.0-or-later
#include "stall_monitor.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

#include "orca/base/log.hpp"

namespace orca::host {
namespace {

constexpr Duration kLimit = 2s;

}  // namespace

StallMonitor::StallMonitor(Executive& executive) : executive_(executive), watcher_([this] { watch(); }) {}

StallMonitor::~StallMonitor() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ended_.notify_one();
  watcher_.join();
}

void StallMonitor::watch() {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, std::chrono::milliseconds(100), [this] { return ending_; })) {
    const auto stuck = executive_.stuck_task(kLimit);
    if (!stuck) continue;
    if (stuck->holds_up_others) end_process(*stuck);
    if (said_.insert(stuck->name).second)
      log::error(
          stuck->name,
          "alarm STALLED: has computed or slept for more than 2 s without waiting for anything of Orca; "
          "let its hook return, or call sleep() or a blocking port function");
  }
}

void StallMonitor::end_process(const StuckTask& stuck) {
  const std::string deed =
      stuck.asleep ? "has slept in the system for more than 2 s" : "has computed for more than 2 s";
  log::error(stuck.name,
             deed +
                 " without waiting for anything of Orca, and holds up all others; let its hook return, or "
                 "call sleep() or a blocking port function");
  std::fflush(nullptr);
  std::_Exit(1);
}

}  // namespace orca::host
