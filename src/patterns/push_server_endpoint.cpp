// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include "orca/patterns/push_endpoint.hpp"

namespace orca {

PushServerEndpoint::PushServerEndpoint(PortHome& home, PortContract contract)
    : Endpoint(home, std::move(contract)),
      base_period_(Endpoint::contract().period.count()),
      mutex_(home.strand.executive()) {}

void PushServerEndpoint::announce(Duration base_period) {
  const std::lock_guard lock(mutex_);
  base_period_ = base_period.count();
  for (Subscription& subscription : subscriptions_) subscription.regrant(base_period);
}

ObjectRef PushServerEndpoint::seal(ObjectLoan loan, const Provenance* provenance) {
  stamp(loan, provenance);
  return std::move(loan).seal();
}

void PushServerEndpoint::publish(ObjectRef object) {
  ++pushed_;
  if (subscriber_count() > 0 && !hand_out(object)) wait_for_room(object);
}

// False if the publisher must wait for room somewhere; otherwise the last subscriber may have got the
// publisher's own view.
bool PushServerEndpoint::hand_out(ObjectRef& object) {
  bool done = true;
  const std::lock_guard lock(mutex_);
  for (Subscription& subscription : subscriptions_) {
    if (!subscription.is_due(object)) continue;
    const bool mine = done && &subscription == &subscriptions_.back();
    const std::optional<Duration> wait =
        mine ? subscription.sink->deliver(std::move(object)) : subscription.sink->deliver(ObjectRef(object));
    if (!wait) continue;
    subscription.owed_until = saturating_add(home().strand.executive().now(), *wait);
    done = false;
  }
  return done;
}

void PushServerEndpoint::wait_for_room(const ObjectRef& object) {
  try {
    while (!home().strand.wait_for(next_limit(), [&] { return settle(object); })) {
    }
  } catch (const Interrupted&) {  // its next blocking call tells the component to leave
    give_up(object);
  }
}

// Tries again where the object is owed; true when it is owed nowhere any more.
bool PushServerEndpoint::settle(const ObjectRef& object) {
  bool settled = true;
  const std::lock_guard lock(mutex_);
  for (Subscription& subscription : subscriptions_) {
    if (!subscription.owed_until) continue;
    if (subscription.sink->deliver(ObjectRef(object))) {
      if (home().strand.executive().now() < *subscription.owed_until) {
        settled = false;
        continue;
      }
      subscription.sink->give_up(object);
    }
    subscription.owed_until.reset();
  }
  return settled;
}

void PushServerEndpoint::give_up(const ObjectRef& object) {
  const std::lock_guard lock(mutex_);
  for (Subscription& subscription : subscriptions_) {
    if (subscription.owed_until) subscription.sink->give_up(object);
    subscription.owed_until.reset();
  }
}

TimePoint PushServerEndpoint::next_limit() const {
  const std::lock_guard lock(mutex_);
  TimePoint next = kForever;
  for (const Subscription& subscription : subscriptions_)
    if (subscription.owed_until) next = std::min(next, *subscription.owed_until);
  return next;
}

PushServerEndpoint::Subscription* PushServerEndpoint::find(PushSink& sink) {
  const auto found = std::ranges::find(subscriptions_, &sink, &Subscription::sink);
  return found == subscriptions_.end() ? nullptr : &*found;
}

bool PushServerEndpoint::Subscription::is_due(const ObjectRef& object) {
  if (to_skip > 0) {
    --to_skip;
    return false;
  }
  if (grant.base_period == Duration{0} && grant.interval > Duration{0}) {
    const TimePoint made(Duration(object.header().creation_time().ns()));
    if (made < next_due) return false;
    next_due = saturating_add(made, grant.interval);
  }
  to_skip = grant.multiple - 1;
  return true;
}

void PushServerEndpoint::Subscription::regrant(Duration base_period) {
  const UpdateGrant before = grant;
  grant = grant_rate(asked, base_period);
  to_skip = std::min(to_skip, grant.multiple - 1);
  if (next_due > TimePoint{}) next_due += grant.interval - before.interval;
  sink->granted(grant);
}

void PushServerEndpoint::Source::attach(PushSink& sink, const UpdateRate& rate) {
  {
    const std::lock_guard lock(server_.mutex_);
    server_.subscriptions_.push_back({&sink, rate});
    server_.subscriptions_.back().regrant(server_.base_period());
    server_.subscribers_.store(server_.subscriptions_.size(), std::memory_order_release);
  }
  server_.home().strand.wake();  // a client connecting may change the server's state
}

void PushServerEndpoint::Source::detach(PushSink& sink) {
  {
    const std::lock_guard lock(server_.mutex_);
    std::erase_if(server_.subscriptions_, [&](const Subscription& s) { return s.sink == &sink; });
    server_.subscribers_.store(server_.subscriptions_.size(), std::memory_order_release);
  }
  server_.home().strand.wake();
}

void PushServerEndpoint::Source::change(PushSink& sink, const UpdateRate& rate) {
  const std::lock_guard lock(server_.mutex_);
  if (Subscription* subscription = server_.find(sink)) {
    subscription->asked = rate;
    subscription->regrant(server_.base_period());
  }
}

void PushServerEndpoint::Source::room(PushSink& /*sink*/) { server_.home().strand.wake(); }

}  // namespace orca
