// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/push_edge.hpp"

#include <algorithm>
#include <cassert>
#include <sstream>
#include <utility>

namespace orca {
namespace {

std::string seconds_text(Duration time) {
  std::ostringstream text;
  text << to_seconds(time) << " s";
  return text.str();
}

std::string described(const QueuePolicy& policy) {
  if (policy.overflow == QueuePolicy::Overflow::drop_oldest && policy.depth == 1) return "queue latest";
  return "queue " + std::to_string(policy.depth) + ", " + to_string(policy.overflow);
}

}  // namespace

PushEdge::PushEdge(Endpoint& client, PushSource& source, const QueuePolicy& policy)
    : PushEdge(client, source.path(), policy) {
  source_ = &source;
}

PushEdge::PushEdge(Endpoint& client, std::string path, const QueuePolicy& policy)
    : client_(client),
      strand_(client.home().strand),
      ages_(strand_.executive().is_virtual() ? nullptr : std::make_unique<RecentTimes>()),
      path_(std::move(path)),
      mutex_(client.home().strand.executive()) {
  fit(policy);
}

// Takes another policy.
void PushEdge::fit(const QueuePolicy& policy) {
  assert(policy.depth > 0);
  std::vector<ObjectRef> ring(policy.depth);
  const std::uint32_t count = count_.load(std::memory_order_relaxed);
  const std::uint32_t kept = std::min(count, policy.depth);
  for (std::uint32_t i = 0; i < kept; ++i)
    ring[i] = std::move(ring_[(first_ + count - kept + i) % policy_.depth]);
  if (count > kept) drop(counts_.dropped_oldest, count - kept);
  ring_ = std::move(ring);
  first_ = 0;
  count_.store(kept, std::memory_order_release);
  policy_ = policy;
  deadline_ = policy.deadline.count();
  const std::optional<std::uint32_t> limit = policy.accepted_drops();
  accepted_drops_ = limit ? std::int64_t{*limit} : -1;
  report_drops_at_ = limit ? std::max<std::uint64_t>(*limit, drops_) + 1 : kNever;
}

void PushEdge::set_policy(const QueuePolicy& policy) {
  bool waited_for = false;
  {
    const MutexLock lock(mutex_);
    note_missed();
    fit(policy);
    subscriber_stuck_ = false;
    waited_for = std::exchange(publisher_waits_, false);
  }
  if (!subscribed()) return;
  if (policy.deadline > Duration{0}) expect_first();
  source()->change(rate());
  if (waited_for) source()->room();
}

std::string PushEdge::source_path() const {
  const MutexLock lock(told_mutex_);
  return path_;
}

void PushEdge::subscribe() {
  if (subscribed_.exchange(true, std::memory_order_acq_rel) || !has_server()) return;
  if (policy_.deadline > Duration{0}) expect_first();
  tell_of_link(true);
  source()->attach(*this, rate());
}

void PushEdge::tell_of_link(bool connected) const {
  if (LinkObserver* observer = client_.home().observer)
    observer->link_changed(client_.path(), source_path(), connected);
}

void PushEdge::move_to(PushSource* next) {
  if (next == source()) return;
  if (subscribed()) {
    source()->detach();
    tell_of_link(false);
  }
  if (next == nullptr) {  // nobody is late from here on
    const MutexLock lock(mutex_);
    note_missed();
  }
  const bool had_server = has_server();
  source_.store(next, std::memory_order_release);
  if (next == nullptr) return;
  {
    const MutexLock lock(told_mutex_);
    path_ = next->path();
  }
  if (!subscribed()) return;
  {
    const MutexLock lock(mutex_);
    publisher_waits_ = subscriber_stuck_ = false;
  }
  if (!had_server && policy_.deadline > Duration{0}) expect_first();
  tell_of_link(true);
  next->attach(*this, rate());
}

void PushEdge::leave() {
  move_to(nullptr);
  forget_objects();
}

void PushEdge::expect_first() {
  const MutexLock lock(mutex_);
  last_arrival_ = now().time_since_epoch().count();
  reported_delays_ = late_arrivals_;
}

void PushEdge::unsubscribe() {
  const bool was_subscribed = subscribed();
  if (was_subscribed) {
    source()->detach();
    tell_of_link(false);
    const MutexLock lock(mutex_);
    note_missed();
  }
  subscribed_.store(false, std::memory_order_release);
  if (was_subscribed) forget_objects();
}

void PushEdge::forget_objects() {
  const MutexLock lock(mutex_);
  counts_.left_behind += count_;
  count_.store(0, std::memory_order_release);
  std::fill(ring_.begin(), ring_.end(), ObjectRef{});
  newest_ = ObjectRef{};  // an object of this subscription is not news to the next one
  publisher_waits_ = subscriber_stuck_ = false;
}

void PushEdge::ask(const UpdateRate& rate) {
  asked_ = rate;
  if (subscribed()) source()->change(this->rate());
}

UpdateRate PushEdge::rate() const {
  return {std::max(asked_.interval, policy_.min_interval), asked_.multiple};
}

UpdateGrant PushEdge::grant() const {
  const MutexLock lock(told_mutex_);
  return grant_;
}

void PushEdge::granted(const UpdateGrant& grant) {
  const MutexLock lock(told_mutex_);
  grant_ = grant;
}

std::optional<Duration> PushEdge::deliver(ObjectRef&& object) {
  const ObjectRef seen = client_.observed() ? object : ObjectRef{};
  bool taken = true;
  std::uint64_t drops = 0;
  {
    const MutexLock lock(mutex_);
    std::uint32_t count = count_.load(std::memory_order_relaxed);
    if (count == policy_.depth) {
      taken = make_room();
      if (!taken && publisher_waits_) return policy_.block_limit;
      drops = drops_to_report();
      --count;
    }
    if (taken) put(std::move(object), count);
  }
  if (drops > 0) report_drops(drops);
  if (!taken) return std::nullopt;
  if (seen) client_.observe(seen);
  strand_.wake();
  return std::nullopt;
}

// Makes room for a new object. Returns false if it cannot go in; it is counted, or its publisher waits.
bool PushEdge::make_room() {
  switch (policy_.overflow) {
    case QueuePolicy::Overflow::drop_oldest:
      drop(counts_.dropped_oldest, 1);
      if (++first_ == policy_.depth) first_ = 0;
      return true;
    case QueuePolicy::Overflow::block:
      if (subscriber_stuck_) {
        drop(counts_.dropped_blocked, 1);
      } else if (!std::exchange(publisher_waits_, true)) {
        ++counts_.waits;
      }
      return false;
    default: drop(counts_.dropped_newest, 1); return false;
  }
}

// Counts lost objects.
void PushEdge::drop(Published<std::uint64_t>& reason, std::uint64_t objects) {
  reason += objects;
  drops_ += objects;
}

// Returns the number of drops if it is to be reported now, otherwise 0. It is reported when it passes the
// limit, and then each time that the excess has doubled, so that a flood costs nothing.
std::uint64_t PushEdge::drops_to_report() {
  const std::uint64_t drops = drops_;
  if (drops < report_drops_at_ || report_drops_at_ == kNever) return 0;
  const std::uint64_t excess = drops - *policy_.accepted_drops();
  report_drops_at_ = drops < kNever - excess ? drops + excess : kNever;
  return drops;
}

void PushEdge::report_drops(std::uint64_t drops) const {
  QueuePolicy policy;
  {
    const MutexLock lock(mutex_);
    policy = policy_;
  }
  report(LinkTrouble::dropped, "objects dropped so far: " + std::to_string(drops) +
                                   ", drop_limit: " + std::to_string(policy.accepted_drops().value_or(0)) +
                                   " (" + described(policy) + ")");
}

void PushEdge::report(LinkTrouble kind, const std::string& text) const {
  if (LinkObserver* observer = client_.home().observer)
    observer->trouble(kind, source_path(), client_.path(), text);
}

// Puts the object into the queue, which holds `count` objects.
void PushEdge::put(ObjectRef&& object, std::uint32_t count) {
  if (ages_) {
    const TimePoint time = now();
    ages_->add(time - TimePoint(Duration(object.header().creation_time().ns())), time);
  }
  std::uint32_t last = first_ + count;
  if (last >= policy_.depth) last -= policy_.depth;
  ring_[last] = std::move(object);
  if (newest_) newest_ = ObjectRef{};
  publisher_waits_ = false;
  count_.store(count + 1, std::memory_order_release);
  if (count + 1 > counts_.high_water) counts_.high_water = count + 1;
  ++counts_.delivered;
  if (policy_.deadline > Duration{0} && count_missed(now())) ++late_arrivals_;
}

// Counts what was missed until a time, from which the next deadline runs. Returns whether there was anything.
bool PushEdge::count_missed(TimePoint time) {
  const std::uint64_t missed = missed_until(time);
  const bool any = missed > counts_.missed_deadlines;
  last_arrival_ = time.time_since_epoch().count();
  counts_.missed_deadlines = missed;
  return any;
}

// Counts what was missed until now, before the deadline changes or nobody waits any more.
void PushEdge::note_missed() {
  if (policy_.deadline > Duration{0} && subscribed()) count_missed(now());
}

void PushEdge::give_up(const ObjectRef& /*object*/) {
  std::uint64_t drops = 0;
  {
    const MutexLock lock(mutex_);
    drop(counts_.dropped_blocked, 1);
    drops = drops_to_report();
    publisher_waits_ = false;
    subscriber_stuck_ = true;
  }
  if (drops > 0) report_drops(drops);
}

void PushEdge::lost(std::uint64_t objects) {
  std::uint64_t drops = 0;
  {
    const MutexLock lock(mutex_);
    drop(counts_.dropped_by_link, objects);
    drops = drops_to_report();
  }
  if (drops > 0) report_drops(drops);
}

// Part of take(), which must not cost a call more.
// @pre  has_new()
[[gnu::always_inline]] inline ObjectRef PushEdge::pop() {
  ObjectRef object;
  bool waited_for = false;
  {
    const MutexLock lock(mutex_);
    const std::uint32_t count = count_.load(std::memory_order_relaxed);
    object = std::move(ring_[first_]);
    if (count == 1) newest_ = object;
    if (++first_ == policy_.depth) first_ = 0;
    count_.store(count - 1, std::memory_order_release);
    subscriber_stuck_ = false;
    waited_for = std::exchange(publisher_waits_, false);
  }
  if (waited_for && has_server()) source()->room();
  return object;
}

ObjectRef PushEdge::take() {
  if (!has_new()) return {};
  strand_.note_activity();
  ObjectRef object = pop();
  strand_.note_activity();
  return object;
}

std::optional<TimePoint> PushEdge::oldest_stamp() const {
  const MutexLock lock(mutex_);
  if (count_.load(std::memory_order_relaxed) == 0) return std::nullopt;
  return ring_[first_].stamp();
}

// It does not count as activity: a lap that has only dropped what matches nothing can be started again.
bool PushEdge::drop_before(TimePoint time) {
  bool dropped = false;
  while (oldest_stamp().value_or(time) < time) {
    static_cast<void>(pop());
    ++counts_.unmatched;
    dropped = true;
  }
  return dropped;
}

ObjectRef PushEdge::latest() const {
  look();
  const MutexLock lock(mutex_);
  const std::uint32_t count = count_.load(std::memory_order_relaxed);
  return count == 0 ? newest_ : ring_[(first_ + count - 1) % policy_.depth];
}

// Called with a deadline only.
std::uint64_t PushEdge::missed_until(TimePoint time) const {
  const Duration since = time.time_since_epoch() - Duration(last_arrival_);
  if (since <= Duration{0}) return counts_.missed_deadlines;
  return counts_.missed_deadlines + static_cast<std::uint64_t>((since - Duration{1}) / Duration(deadline_));
}

bool PushEdge::deadline_missed() const {
  if (policy_.deadline <= Duration{0} || !subscribed()) return false;
  return now().time_since_epoch() - Duration(last_arrival_) > policy_.deadline;
}

TimePoint PushEdge::watch_deadline() {
  if (policy_.deadline <= Duration{0} || !subscribed()) return kForever;
  TimePoint next = kForever;
  bool is_new = false;
  {
    const MutexLock lock(mutex_);
    const TimePoint due = saturating_add(TimePoint(Duration(last_arrival_)), policy_.deadline);
    const bool is_late = now() > due;
    const std::uint64_t delays = late_arrivals_ + (is_late ? 1 : 0);
    is_new = delays > std::exchange(reported_delays_, delays);
    if (!is_late) next = saturating_add(due, Duration{1});
  }
  if (is_new) report(LinkTrouble::late, "no object within the deadline of " + seconds_text(policy_.deadline));
  return next;
}

std::optional<TimeFigures> PushEdge::ages() const {
  return ages_ ? std::optional(ages_->figures(now())) : std::nullopt;
}

EdgeCounters PushEdge::counters() const {
  EdgeCounters counted;
  counted.delivered = counts_.delivered;
  counted.dropped_oldest = counts_.dropped_oldest;
  counted.dropped_newest = counts_.dropped_newest;
  counted.dropped_blocked = counts_.dropped_blocked;
  counted.dropped_by_link = counts_.dropped_by_link;
  counted.unmatched = counts_.unmatched;
  counted.left_behind = counts_.left_behind;
  counted.dropped = counted.dropped_oldest + counted.dropped_newest + counted.dropped_blocked +
                    counted.dropped_by_link + counted.unmatched + counted.left_behind;
  const std::uint64_t drops = drops_;
  if (const std::int64_t limit = accepted_drops_; limit >= 0)
    counted.over_limit = drops - std::min(drops, static_cast<std::uint64_t>(limit));
  counted.waits = counts_.waits;
  const bool due = deadline_ > 0 && subscribed();
  counted.missed_deadlines = due ? missed_until(now()) : std::uint64_t{counts_.missed_deadlines};
  counted.queued = count_.load(std::memory_order_relaxed);
  counted.high_water = counts_.high_water;
  return counted;
}

}  // namespace orca
