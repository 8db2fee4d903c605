// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/synchronizer.hpp"

#include <algorithm>
#include <cassert>

#include "orca/base/strand.hpp"
#include "orca/patterns/endpoints/gathering.hpp"

namespace orca {

void Synchronizer::add(PushSubject& subject) {
  if (std::find(subjects_.begin(), subjects_.end(), &subject) == subjects_.end())
    subjects_.push_back(&subject);
}

void Synchronizer::remove(PushSubject& subject) { std::erase(subjects_, &subject); }

void Synchronizer::wait(PushSubject& subject) {
  assert(std::find(subjects_.begin(), subjects_.end(), &subject) != subjects_.end());
  strand().wait_for(kForever, [&] { return subject.new_data_arrived(); });
}

bool Synchronizer::wait(PushSubject& subject, Duration limit) {
  assert(std::find(subjects_.begin(), subjects_.end(), &subject) != subjects_.end());
  return strand().wait_for(deadline_in(limit), [&] { return subject.new_data_arrived(); });
}

PushSubject& Synchronizer::wait() { return *wait_any_until(kForever); }

PushSubject* Synchronizer::wait(Duration limit) { return wait_any_until(deadline_in(limit)); }

PushSubject* Synchronizer::wait(Duration limit, const std::function<bool()>& unless) {
  PushSubject* found = nullptr;
  strand().wait_for(deadline_in(limit), [&] { return (found = first_new()) != nullptr || unless(); });
  return found;
}

PushSubject* Synchronizer::wait_any_until(TimePoint deadline) {
  PushSubject* found = nullptr;
  strand().wait_for(deadline, [&] { return (found = first_new()) != nullptr; });
  return found;
}

void Synchronizer::wait_all() {
  strand().wait_for(kForever, [this] { return all_new(endpoints()); });
}

bool Synchronizer::wait_all(Duration limit) {
  return strand().wait_for(deadline_in(limit), [this] { return all_new(endpoints()); });
}

bool Synchronizer::wait_all(Duration limit, const std::function<bool()>& unless) {
  strand().wait_for(deadline_in(limit), [&] { return all_new(endpoints()) || unless(); });
  return all_new(endpoints());
}

void Synchronizer::wait_matching(Duration within) { wait_matching_until(within, kForever); }

bool Synchronizer::wait_matching(Duration within, Duration limit) {
  return wait_matching_until(within, deadline_in(limit));
}

bool Synchronizer::wait_matching_until(Duration within, TimePoint deadline) {
  return strand().wait_for(deadline, [&] { return match(endpoints(), within); });
}

void Synchronizer::wait_to_fuse(Fusing policy, Duration time) {
  switch (policy) {
    case Fusing::all: wait_all(); break;
    case Fusing::any: wait(); break;
    case Fusing::clock: wait_for_tick(time); break;
    case Fusing::stamps: wait_matching(time); break;
  }
}

void Synchronizer::wait_for_tick(Duration period) {
  assert(period > Duration{0});
  const TimePoint now = strand().executive().now();
  const TimePoint start = last_tick_ == TimePoint{} ? now : last_tick_;
  const TimePoint tick = start + period * std::max<Duration::rep>(1, (now - start + period - 1ns) / period);
  strand().wait_for(tick, [] { return false; });
  last_tick_ = tick;
}

Strand& Synchronizer::strand() const {
  assert(!subjects_.empty());
  return subjects_.front()->strand();
}

TimePoint Synchronizer::deadline_in(Duration limit) const {
  return saturating_add(strand().executive().now(), limit);
}

// The endpoints are known only after the component's constructor, in which it adds its ports, and they are others once
// the component's object has taken another one's place.
const Synchronizer::Endpoints& Synchronizer::endpoints() {
  endpoints_.clear();
  for (const PushSubject* subject : subjects_) endpoints_.push_back(&subject->endpoint());
  return endpoints_;
}

PushSubject* Synchronizer::first_new() const {
  const auto found =
      std::find_if(subjects_.begin(), subjects_.end(), [](const auto* s) { return s->new_data_arrived(); });
  return found == subjects_.end() ? nullptr : *found;
}

}  // namespace orca
