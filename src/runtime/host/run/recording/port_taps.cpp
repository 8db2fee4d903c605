// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/port_taps.hpp"

#include <algorithm>
#include <utility>

namespace orca::host {

Flow flow_of(const PortContract& port) {
  if (port.pattern == Pattern::push && port.role == Role::server) return Flow::pushed;
  return port.pattern == Pattern::send && port.role == Role::proxy ? Flow::requested : Flow::delivered;
}

PortTap::PortTap(std::vector<Place> places, const Bounds& bounds)
    : places_(std::move(places)), bounds_(bounds), lost_(places_.size()) {
  waiting_.reserve(Bounds{}.objects);
}

bool PortTap::is_at(Flow flow, std::string_view component, std::string_view port) const {
  return std::ranges::any_of(places_, [&](const Place& place) {
    return place.flow == flow && place.port == port && place.component == component;
  });
}

bool PortTap::has_room(std::size_t bytes) const {
  if (waiting_.size() >= bounds_.objects) return false;
  return bounds_.bytes == 0 || waiting_.empty() || waiting_bytes_ + bytes <= bounds_.bytes;
}

void PortTap::put(Flow flow, std::string_view component, std::string_view port, const ObjectRef& object,
                  std::size_t bytes, TimePoint time) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    if (place.flow != flow || place.port != port || place.component != component) continue;
    const MutexLock lock(mutex_);
    if (!has_room(bytes)) {
      ++lost_[i];
    } else {
      waiting_.push_back({object, time, i});
      waiting_bytes_ += bytes;
    }
  }
}

std::vector<PortTap::Passed> PortTap::take() {
  std::vector<Passed> taken;
  taken.reserve(Bounds{}.objects);
  const MutexLock lock(mutex_);
  taken.swap(waiting_);
  waiting_bytes_ = 0;
  return taken;
}

std::vector<std::uint64_t> PortTap::lost() const {
  const MutexLock lock(mutex_);
  return lost_;
}

std::shared_ptr<PortTap> PortTaps::open(std::vector<PortTap::Place> places, const PortTap::Bounds& bounds) {
  std::shared_ptr<PortTap> tap(new PortTap(std::move(places), bounds));
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
    return tap && tap->is_at(flow, component, port);
  });
}

PortTaps::Taps PortTaps::taps_at(Flow flow, std::string_view component, std::string_view port) {
  Taps found;
  const MutexLock lock(mutex_);
  bool has_expired = false;
  for (const auto& weak : taps_) {
    std::shared_ptr<PortTap> tap = weak.lock();
    has_expired = has_expired || !tap;
    if (tap && tap->is_at(flow, component, port)) found.push_back(std::move(tap));
  }
  if (!has_expired) return found;
  std::erase_if(taps_, [](const auto& tap) { return tap.expired(); });
  count_.store(taps_.size(), std::memory_order_relaxed);
  return found;
}

// An object is measured at most once, and without the lock, for other components pass theirs meanwhile.
void PortTaps::pass_on(Flow flow, std::string_view component, std::string_view port,
                       const ObjectRef& object) {
  const TimePoint now = executive_.now();
  const Taps taps = taps_at(flow, component, port);
  const bool is_measured = std::ranges::any_of(taps, &PortTap::counts_bytes);
  const std::size_t bytes = is_measured ? object.type().write(object.get(), {}) : 0;
  for (const auto& tap : taps) tap->put(flow, component, port, object, bytes, now);
}

}  // namespace orca::host
