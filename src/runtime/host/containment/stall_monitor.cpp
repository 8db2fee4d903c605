// SPDX-License-Identifier: LGPL-3.0-or-later
#include "stall_monitor.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>

#include "orca/base/text.hpp"

namespace orca::host {
namespace {

constexpr Duration kLimit = 2s;
constexpr Duration kLook = 100ms;  // between two looks, or a tenth of a shorter limit

// Returns "has computed for more than 2 s ...".
std::string description(const std::string& what, Duration limit, const std::string& consequence) {
  return what + " for more than " + seconds_text(limit) + " without waiting for anything of Orca" +
         consequence + "; let its hook return, or call sleep() or a blocking port function";
}

}  // namespace

StallMonitor::StallMonitor(Executive& executive, AlarmSink sink, Standstill standstill,
                           const std::atomic<Duration>& hang_limit)
    : executive_(executive),
      sink_(std::move(sink)),
      standstill_(std::move(standstill)),
      hang_limit_(hang_limit),
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
  Duration hang_limit = hang_limit_.load();
  const auto pause = [&] { return hang_limit > Duration{0} ? std::min(kLook, hang_limit / 10) : kLook; };
  while (!ended_.wait_for(lock, pause(), [this] { return ending_; })) {
    look(hang_limit);
    hang_limit = hang_limit_.load();
  }
}

void StallMonitor::look(Duration hang_limit) {
  const Duration limit = hang_limit > Duration{0} ? hang_limit : kLimit;
  const auto stuck = executive_.stuck_task(limit);
  if (!stuck) return;
  if (stuck->holds_up_others) {
    const std::string what = stuck->asleep ? "has slept in the system" : "has computed";
    standstill_(stuck->name, description(what, limit, ", and holds up all others"));
    return;
  }
  const std::string text = description("has computed or slept", limit, "");
  if (hang_limit > Duration{0})
    standstill_(stuck->name, text);
  else if (said_.insert(stuck->name).second)
    sink_(make_alarm(idl::STALLED, stuck->name, "", text));
}

}  // namespace orca::host
