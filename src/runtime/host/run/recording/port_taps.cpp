// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/port_taps.hpp"

#include <algorithm>
#include <utility>

namespace orca::host {

Flow flow_of(const PortContract& port) {
  if (port.pattern == Pattern::push && port.role == Role::server) return Flow::pushed;
  return port.pattern == Pattern::send && port.role == Role::proxy ? Flow::requested : Flow::delivered;
}

PortTap::PortTap(std::string component, std::string port, Flow flow)
    : component_(std::move(component)), port_(std::move(port)), flow_(flow) {
  waiting_.reserve(kMost);
}

void PortTap::put(const ObjectRef& object, TimePoint time) {
  const MutexLock lock(mutex_);
  if (waiting_.size() == kMost) {
    ++lost_;
  } else {
    waiting_.push_back({object, time});
  }
}

std::vector<PortTap::Passed> PortTap::take() {
  std::vector<Passed> taken;
  taken.reserve(kMost);
  const MutexLock lock(mutex_);
  taken.swap(waiting_);
  return taken;
}

std::uint64_t PortTap::lost() const {
  const MutexLock lock(mutex_);
  return lost_;
}

std::shared_ptr<PortTap> PortTaps::open(const std::string& component, const PortContract& port) {
  std::shared_ptr<PortTap> tap(new PortTap(component, port.name, flow_of(port)));
  const MutexLock lock(mutex_);
  std::erase_if(taps_, [](const auto& other) { return other.expired(); });
  taps_.push_back(tap);
  count_.store(taps_.size(), std::memory_order_relaxed);
  return tap;
}

bool PortTaps::are_at(Flow flow, std::string_view component, std::string_view port) const {
  if (count_.load(std::memory_order_relaxed) == 0) return false;
  const MutexLock lock(mutex_);
  return std::ranges::any_of(taps_, [&](const std::weak_ptr<PortTap>& weak) {
    const std::shared_ptr<PortTap> tap = weak.lock();
    return tap && tap->flow_ == flow && tap->port_ == port && tap->component_ == component;
  });
}

void PortTaps::pass_on(Flow flow, std::string_view component, std::string_view port,
                       const ObjectRef& object) {
  const TimePoint now = executive_.now();
  const MutexLock lock(mutex_);
  bool has_expired = false;
  for (const auto& weak : taps_) {
    const std::shared_ptr<PortTap> tap = weak.lock();
    has_expired = has_expired || !tap;
    if (tap && tap->flow_ == flow && tap->port_ == port && tap->component_ == component)
      tap->put(object, now);
  }
  if (!has_expired) return;
  std::erase_if(taps_, [](const auto& tap) { return tap.expired(); });
  count_.store(taps_.size(), std::memory_order_relaxed);
}

}  // namespace orca::host
