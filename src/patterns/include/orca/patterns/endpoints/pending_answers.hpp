// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "orca/base/mutex.hpp"

namespace orca {

/// The answers that one client waits for, each under its own id. They are few, so they are searched one by
/// one. After warm-up nothing is allocated from the heap.
///
/// Thread contract: any thread.
template <class Answer>
class PendingAnswers {
 public:
  enum class State { unknown, waiting, answered };

  /// Returns a new id that waits for its answer.
  [[nodiscard]] std::uint64_t add() {
    const MutexLock lock(mutex_);
    entries_.push_back({next_id_, std::nullopt});
    return next_id_++;
  }

  /// @return false if nobody waits for it any more, or it has its answer already.
  bool answer(std::uint64_t id, Answer answer) {
    const MutexLock lock(mutex_);
    const auto entry = find(id);
    if (entry == entries_.end() || entry->answer) return false;
    entry->answer.emplace(std::move(answer));
    return true;
  }

  [[nodiscard]] State state(std::uint64_t id) const {
    const MutexLock lock(mutex_);
    const auto entry = std::ranges::find(entries_, id, &Entry::id);
    if (entry == entries_.end()) return State::unknown;
    return entry->answer ? State::answered : State::waiting;
  }

  /// Returns the answer, once; nothing while there is none.
  [[nodiscard]] std::optional<Answer> take(std::uint64_t id) {
    const MutexLock lock(mutex_);
    const auto entry = find(id);
    if (entry == entries_.end() || !entry->answer) return std::nullopt;
    std::optional<Answer> answer = std::move(entry->answer);
    remove(entry);
    return answer;
  }

  /// Returns the ids that wait for their answers.
  [[nodiscard]] std::vector<std::uint64_t> waiting() const {
    const MutexLock lock(mutex_);
    std::vector<std::uint64_t> ids;
    for (const Entry& entry : entries_)
      if (!entry.answer) ids.push_back(entry.id);
    return ids;
  }

  /// Discards the answer to this id, now or when it comes.
  void forget(std::uint64_t id) {
    const MutexLock lock(mutex_);
    const auto entry = find(id);
    if (entry != entries_.end()) remove(entry);
  }

 private:
  struct Entry {
    std::uint64_t id;
    std::optional<Answer> answer;
  };
  using Place = typename std::vector<Entry>::iterator;

  Place find(std::uint64_t id) { return std::ranges::find(entries_, id, &Entry::id); }
  void remove(Place entry) {
    if (entry != entries_.end() - 1) *entry = std::move(entries_.back());
    entries_.pop_back();
  }

  mutable Mutex mutex_;
  std::uint64_t next_id_ = 1;
  std::vector<Entry> entries_;
};

}  // namespace orca
