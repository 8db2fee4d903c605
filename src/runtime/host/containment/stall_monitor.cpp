// SPDX-License-Identifier: LGPL-3.0-or-later
#include "stall_monitor.hpp"

#include <string>
#include <utility>

namespace orca::host {
namespace {

constexpr Duration kLimit = 2s;
constexpr const char* kAdvice =
    " for more than 2 s without waiting for anything of Orca, and holds up all others; let its hook return, "
    "or call "
    "sleep() or a blocking port function";

}  // namespace

StallMonitor::StallMonitor(Executive& executive, AlarmSink sink, Standstill standstill)
    : executive_(executive),
      sink_(std::move(sink)),
      standstill_(std::move(standstill)),
      watcher_([this] { watch(); }) {}

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
    if (stuck->holds_up_others) {
      standstill_(stuck->name,
                  (stuck->asleep ? "has slept in the system" : "has computed") + std::string(kAdvice));
    } else if (said_.insert(stuck->name).second) {
      sink_(make_alarm(
          AlarmKind::stalled, stuck->name, "",
          "has computed or slept for more than 2 s without waiting for anything of Orca; let its hook "
          "return, or call sleep() or a blocking port function"));
    }
  }
}

}  // namespace orca::host
