// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cassert>

#include "orca/patterns/push_endpoint.hpp"

namespace orca {

PushEdge::PushEdge(Endpoint& client, PushSource& source, const QueuePolicy& policy)
    : client_(client), source_(source), policy_(policy), ring_(policy.depth) {
  assert(policy.depth > 0);
}

void PushEdge::subscribe() {
  if (subscribed_.exchange(true, std::memory_order_acq_rel)) return;
  if (policy_.deadline > Duration{0}) {
    const std::lock_guard lock(mutex_);
    last_arrival_ = now();
  }
  if (LinkObserver* observer = client_.home().observer)
    observer->link_changed(client_.path(), source_.path(), true);
  source_.attach(*this, rate());
}

void PushEdge::unsubscribe() {
  if (!subscribed()) return;
  source_.detach(*this);
  if (LinkObserver* observer = client_.home().observer)
    observer->link_changed(client_.path(), source_.path(), false);
  const std::lock_guard lock(mutex_);
  subscribed_.store(false, std::memory_order_release);
  counters_.missed_deadlines = missed_until(now());
  counters_.left_behind += count_;
  count_.store(0, std::memory_order_release);
  std::fill(ring_.begin(), ring_.end(), ObjectRef{});
  newest_ = ObjectRef{};  // what was true before is not news to the next subscription
  publisher_waits_ = subscriber_stuck_ = false;
}

void PushEdge::ask(const UpdateRate& rate) {
  asked_ = rate;
  if (subscribed()) source_.change(*this, this->rate());
}

UpdateRate PushEdge::rate() const {
  return {std::max(asked_.interval, policy_.min_interval), asked_.multiple};
}

UpdateGrant PushEdge::grant() const {
  const std::lock_guard lock(mutex_);
  return grant_;
}

void PushEdge::granted(const UpdateGrant& grant) {
  const std::lock_guard lock(mutex_);
  grant_ = grant;
}

std::optional<Duration> PushEdge::deliver(const ObjectRef& object) {
  {
    const std::lock_guard lock(mutex_);
    if (count_.load(std::memory_order_relaxed) == ring_.size() && !make_room()) {
      if (!publisher_waits_) return std::nullopt;
      return policy_.block_limit;
    }
    put(object);
  }
  client_.observe(object);
  client_.home().strand.wake();
  return std::nullopt;
}

// False if the new object cannot go in; it is counted, or its publisher waits.
bool PushEdge::make_room() {
  switch (policy_.overflow) {
    case QueuePolicy::Overflow::drop_oldest:
      ++counters_.dropped_oldest;
      first_ = (first_ + 1) % policy_.depth;
      count_.store(policy_.depth - 1, std::memory_order_release);
      return true;
    case QueuePolicy::Overflow::block:
      if (subscriber_stuck_) {
        ++counters_.dropped_blocked;
      } else if (!publisher_waits_) {
        publisher_waits_ = true;
        ++counters_.waits;
      }
      return false;
    default: ++counters_.dropped_newest; return false;
  }
}

void PushEdge::put(const ObjectRef& object) {
  const std::uint32_t count = count_.load(std::memory_order_relaxed);
  std::uint32_t last = first_ + count;
  if (last >= policy_.depth) last -= policy_.depth;
  ring_[last] = object;
  newest_ = object;
  publisher_waits_ = false;
  count_.store(count + 1, std::memory_order_release);
  counters_.high_water = std::max(counters_.high_water, count + 1);
  ++counters_.delivered;
  if (policy_.deadline > Duration{0}) {
    const TimePoint time = now();
    counters_.missed_deadlines = missed_until(time);
    last_arrival_ = time;
  }
}

void PushEdge::give_up(const ObjectRef& /*object*/) {
  const std::lock_guard lock(mutex_);
  ++counters_.dropped_blocked;
  publisher_waits_ = false;
  subscriber_stuck_ = true;
}

ObjectRef PushEdge::take() {
  if (!has_new()) return {};
  ObjectRef object;
  bool waited_for = false;
  {
    const std::lock_guard lock(mutex_);
    const std::uint32_t count = count_.load(std::memory_order_relaxed);
    if (count == 0) return {};
    object = std::move(ring_[first_]);
    if (++first_ == policy_.depth) first_ = 0;
    count_.store(count - 1, std::memory_order_release);
    subscriber_stuck_ = false;
    waited_for = std::exchange(publisher_waits_, false);
  }
  if (waited_for) source_.room(*this);
  return object;
}

ObjectRef PushEdge::latest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

std::uint64_t PushEdge::missed_until(TimePoint time) const {
  const Duration since = time - last_arrival_;
  if (policy_.deadline <= Duration{0} || since <= Duration{0}) return counters_.missed_deadlines;
  return counters_.missed_deadlines + static_cast<std::uint64_t>((since - Duration{1}) / policy_.deadline);
}

bool PushEdge::deadline_missed() const {
  if (policy_.deadline <= Duration{0} || !subscribed()) return false;
  const std::lock_guard lock(mutex_);
  return now() - last_arrival_ > policy_.deadline;
}

EdgeCounters PushEdge::counters() const {
  const std::lock_guard lock(mutex_);
  EdgeCounters now_counted = counters_;
  if (subscribed()) now_counted.missed_deadlines = missed_until(now());
  now_counted.queued = count_.load(std::memory_order_relaxed);
  now_counted.dropped =
      counters_.dropped_oldest + counters_.dropped_newest + counters_.dropped_blocked + counters_.left_behind;
  return now_counted;
}

PushClientEndpoint::PushClientEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

PushEdge& PushClientEndpoint::connect(PushSource& source, const QueuePolicy& policy) {
  assert(contract().many || edges_.empty());
  edges_.push_back(std::make_unique<PushEdge>(*this, source, policy));
  return *edges_.back();
}

bool PushClientEndpoint::has_new() const {
  return std::any_of(edges_.begin(), edges_.end(), [](const auto& edge) { return edge->has_new(); });
}

void PushClientEndpoint::subscribe_all() {
  for (const auto& edge : edges_) edge->subscribe();
}

void PushClientEndpoint::unsubscribe_all() {
  for (const auto& edge : edges_) edge->unsubscribe();
}

}  // namespace orca
