// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/courier.hpp"

#include <cassert>
#include <utility>

namespace orca {
namespace {

constexpr int kBeforeComponents = 1000;  // priority; components have 100 at most

}  // namespace

void Courier::post(const void* owner, Duration delay, std::function<void()> arrive, std::uint64_t number) {
  assert(!executive_.tasks_overlap());
  if (ended_) return;
  const TimePoint due = saturating_add(executive_.now(), delay);
  const bool is_first = letters_.empty() || due < letters_.begin()->first;
  letters_.emplace(due, Letter{owner, number, std::move(arrive)});
  if (task_ == nullptr) {
    posted_ = executive_.make_event();
    task_ = executive_.spawn({.name = "courier", .priority = kBeforeComponents}, [this] { carry(); });
  } else if (is_first) {
    posted_->notify();
  }
}

void Courier::recall(const void* owner) {
  std::erase_if(letters_, [&](const auto& entry) { return entry.second.owner == owner; });
}

bool Courier::recall(const void* owner, std::uint64_t number) {
  return std::erase_if(letters_, [&](const auto& entry) {
           return entry.second.owner == owner && entry.second.number == number;
         }) > 0;
}

void Courier::end() {
  ended_ = true;
  letters_.clear();
  if (task_ == nullptr) return;
  posted_->notify();
  task_.reset();
}

// Whoever gets a letter may post others.
void Courier::carry() {
  while (!ended_) {
    if (letters_.empty() || letters_.begin()->first > executive_.now()) {
      posted_->wait_until(letters_.empty() ? kForever : letters_.begin()->first);
    } else {
      letters_.extract(letters_.begin()).mapped().arrive();
    }
  }
}

}  // namespace orca
