// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/push_endpoint.hpp"

#include <algorithm>
#include <cassert>

namespace orca {

PushServerEndpoint::PushServerEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

ObjectRef PushServerEndpoint::push(ObjectLoan loan, const Provenance* provenance) {
  stamp(loan, provenance);
  const ObjectRef object = std::move(loan).seal();
  const std::lock_guard lock(mutex_);
  for (PushSink* sink : sinks_) sink->deliver(object);
  return object;
}

void PushServerEndpoint::Source::attach(PushSink& sink) {
  {
    const std::lock_guard lock(server_.mutex_);
    server_.sinks_.push_back(&sink);
    server_.subscribers_.store(server_.sinks_.size(), std::memory_order_release);
  }
  server_.home().strand.wake();  // a client connecting may change the server's state
}

void PushServerEndpoint::Source::detach(PushSink& sink) {
  {
    const std::lock_guard lock(server_.mutex_);
    std::erase(server_.sinks_, &sink);
    server_.subscribers_.store(server_.sinks_.size(), std::memory_order_release);
  }
  server_.home().strand.wake();
}

PushEdge::PushEdge(Endpoint& client, PushSource& source, QueuePolicy policy,
                   std::function<void(const ObjectRef&)> observe)
    : client_(client), source_(source), policy_(policy), observe_(std::move(observe)), ring_(policy.depth) {
  assert(policy.depth > 0);
}

void PushEdge::subscribe() {
  if (subscribed_) return;
  subscribed_ = true;
  if (LinkObserver* observer = client_.home().observer)
    observer->link_changed(client_.path(), source_.path(), true);
  source_.attach(*this);
}

void PushEdge::unsubscribe() {
  if (!subscribed_) return;
  subscribed_ = false;
  source_.detach(*this);
  if (LinkObserver* observer = client_.home().observer)
    observer->link_changed(client_.path(), source_.path(), false);
  const std::lock_guard lock(mutex_);
  std::fill(ring_.begin(), ring_.end(), ObjectRef{});
  count_ = 0;
  last_made_.reset();
  newest_ = ObjectRef{};  // what was true before is not news to the next subscription
}

void PushEdge::deliver(const ObjectRef& object) {
  {
    const std::lock_guard lock(mutex_);
    if (!interval_has_passed(object)) return;
    if (count_ == ring_.size()) {
      ++counters_.dropped;
      if (policy_.overflow == QueuePolicy::Overflow::drop_newest) return;
      first_ = (first_ + 1) % ring_.size();
      --count_;
    }
    ring_[(first_ + count_) % ring_.size()] = object;
    ++count_;
    newest_ = object;
    ++counters_.delivered;
  }
  observe_(object);
  client_.home().strand.wake();
}

bool PushEdge::interval_has_passed(const ObjectRef& object) {
  if (policy_.min_interval <= Duration{0}) return true;
  const Duration made(object.header().creation_time().ns());
  if (last_made_ && made < *last_made_ + policy_.min_interval) return false;
  last_made_ = made;
  return true;
}

ObjectRef PushEdge::take() {
  const std::lock_guard lock(mutex_);
  if (count_ == 0) return {};
  ObjectRef object = std::move(ring_[first_]);
  first_ = (first_ + 1) % ring_.size();
  --count_;
  client_.home().strand.note_activity();
  return object;
}

ObjectRef PushEdge::latest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

bool PushEdge::has_new() const {
  const std::lock_guard lock(mutex_);
  return count_ > 0;
}

EdgeCounters PushEdge::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

PushClientEndpoint::PushClientEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)) {}

PushEdge& PushClientEndpoint::connect(PushSource& source, const QueuePolicy& policy) {
  assert(contract().many || edges_.empty());
  edges_.push_back(std::make_unique<PushEdge>(*this, source, policy,
                                              [this](const ObjectRef& object) { observe(object); }));
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
