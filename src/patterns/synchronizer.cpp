// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/synchronizer.hpp"

#include <algorithm>
#include <cassert>

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

PushProxyHandle& Synchronizer::wait() {
  PushProxyHandle* found = nullptr;
  strand().wait_for(kForever, [&] { return (found = first_new()) != nullptr; });
  return *found;
}

void Synchronizer::wait_all() {
  strand().wait_for(kForever, [this] { return all_new(); });
}

bool Synchronizer::wait_all(Duration limit) {
  return strand().wait_for(saturating_add(strand().executive().now(), limit), [this] { return all_new(); });
}

Strand& Synchronizer::strand() const {
  assert(!subjects_.empty());
  return subjects_.front()->endpoint().home().strand;
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
