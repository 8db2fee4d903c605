// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/component/host.hpp"

namespace orca::host {

/// The orders of one component about others: those that nobody has taken to carry them out, and the outcomes that the component has not
/// taken yet. They outlive its code.
///
/// Thread contract: any thread.
class PeerOrders {
 public:
  /// Notes an order. @return its number.
  std::uint64_t begin(PeerOrder order) {
    const MutexLock lock(mutex_);
    waiting_.emplace_back(++last_, std::move(order));
    waits_.store(true, std::memory_order_release);
    return last_;
  }
  /// Notes an order that is refused at once. @return its number.
  std::uint64_t refuse(Error reason) {
    const MutexLock lock(mutex_);
    outcomes_.emplace(++last_, std::move(reason));
    return last_;
  }
  /// Takes the oldest order that waits to be carried out, if there is one, and its number.
  std::optional<std::pair<std::uint64_t, PeerOrder>> take_order() {
    if (!waits_.load(std::memory_order_acquire)) return std::nullopt;
    const MutexLock lock(mutex_);
    std::pair<std::uint64_t, PeerOrder> oldest = std::move(waiting_.front());
    waiting_.pop_front();
    waits_.store(!waiting_.empty(), std::memory_order_release);
    return oldest;
  }
  /// Notes the outcome of an order.
  void conclude(std::uint64_t number, Result<std::string> outcome) {
    const MutexLock lock(mutex_);
    outcomes_.emplace(number, std::move(outcome));
  }
  /// Returns the outcome of an order, and forgets it; nothing as long as there is none.
  /// @errors  data_loss for an order that the component has given in another process, which is lost.
  std::optional<Result<std::string>> take(std::uint64_t number) {
    const MutexLock lock(mutex_);
    if (number > last_)
      return fail(Code::data_loss, "nobody knows of this order: the process in which it was given is lost");
    auto found = outcomes_.extract(number);
    if (found.empty()) return std::nullopt;
    return std::move(found.mapped());
  }

 private:
  std::atomic<bool> waits_{false};
  Mutex mutex_;
  std::uint64_t last_ ORCA_GUARDED_BY(mutex_) = 0;
  std::deque<std::pair<std::uint64_t, PeerOrder>> waiting_ ORCA_GUARDED_BY(mutex_);
  std::map<std::uint64_t, Result<std::string>> outcomes_ ORCA_GUARDED_BY(mutex_);
};

}  // namespace orca::host
