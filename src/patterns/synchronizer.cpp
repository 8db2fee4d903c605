// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/synchronizer.hpp"

#include <algorithm>
#include <cassert>

#include "orca/base/strand.hpp"

namespace orca {

void Synchronizer::add(PushProxyHandle& subject) {
  if (std::find(subjects_.begin(), subjects_.end(), &subject) == subjects_.end())
    subjects_.push_back(&subject);
}

void Synchronizer::remove(PushProxyHandle& subject) { std::erase(subjects_, &subject); }

void Synchronizer::wait(PushProxyHandle& subject) {
  assert(std::find(subjects_.begin(), subjects_.end(), &subject) != subjects_.end());
  strand().wait_for(kForever, [&] { return subject.new_data_arrived(); });
}

bool Synchronizer::wait(PushProxyHandle& subject, Duration limit) {
  assert(std::find(subjects_.begin(), subjects_.end(), &subject) != subjects_.end());
  return strand().wait_for(deadline_in(limit), [&] { return subject.new_data_arrived(); });
}

PushProxyHandle& Synchronizer::wait() { return *wait_any_until(kForever); }

PushProxyHandle* Synchronizer::wait(Duration limit) { return wait_any_until(deadline_in(limit)); }

PushProxyHandle* Synchronizer::wait_any_until(TimePoint deadline) {
  PushProxyHandle* found = nullptr;
  strand().wait_for(deadline, [&] { return (found = first_new()) != nullptr; });
  return found;
}

void Synchronizer::wait_all() {
  strand().wait_for(kForever, [this] { return all_new(); });
}

bool Synchronizer::wait_all(Duration limit) {
  return strand().wait_for(deadline_in(limit), [this] { return all_new(); });
}

void Synchronizer::wait_to_fuse(Fusing policy, Duration period) {
  switch (policy) {
    case Fusing::all: wait_all(); break;
    case Fusing::any: wait(); break;
    case Fusing::clock: wait_for_tick(period); break;
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

bool Synchronizer::all_new() const {
  return std::all_of(subjects_.begin(), subjects_.end(), [](const auto* s) { return s->new_data_arrived(); });
}

PushProxyHandle* Synchronizer::first_new() const {
  const auto found =
      std::find_if(subjects_.begin(), subjects_.end(), [](const auto* s) { return s->new_data_arrived(); });
  return found == subjects_.end() ? nullptr : *found;
}

}  // namespace orca
