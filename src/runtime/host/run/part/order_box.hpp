// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "orca/base/mutex.hpp"
#include "orca/host/part_access.hpp"

namespace orca::host {

/// The orders that a part was given and has not carried out yet.
///
/// Thread contract: put() and is_to_end() from any thread, the rest from the part's main task.
class OrderBox {
 public:
  /// @param arrived  called when there is an order, on the thread that gives it.
  explicit OrderBox(std::function<void()> arrived) : arrived_(std::move(arrived)) {}

  /// Puts an order in. After close() it is refused at once.
  void put(PartOrder order) {
    {
      const MutexLock lock(mutex_);
      if (order.kind == PartOrder::Kind::take_down) is_to_end_ = true;
      if (!end_) {
        orders_.push_back(std::move(order));
        return arrived_();
      }
    }
    refuse(order);
  }

  /// Returns whether take_down is ordered: what comes before it waits for nothing any more.
  [[nodiscard]] bool is_to_end() const { return is_to_end_; }

  /// Takes the oldest order out, if there is one.
  std::optional<PartOrder> take() {
    const MutexLock lock(mutex_);
    if (orders_.empty()) return std::nullopt;
    PartOrder order = std::move(orders_.front());
    orders_.pop_front();
    return order;
  }

  /// Refuses what is left, and whatever comes from now on.
  /// @param end  what has become of the end of the part.
  void close(const Status& end) {
    {
      const MutexLock lock(mutex_);
      end_ = end;
    }
    while (const std::optional<PartOrder> order = take()) refuse(*order);
  }

 private:
  // To end is what happens already: whoever else orders that gets the same answer. A signal may have come before the order.
  void refuse(const PartOrder& order) const {
    const Error ends = fail(Code::failed_precondition, "the process is being taken down");
    if (order.done) order.done(order.kind == PartOrder::Kind::take_down ? *end_ : Status(ends));
    if (order.swapped) order.swapped(ends);
  }

  const std::function<void()> arrived_;
  std::atomic<bool> is_to_end_{false};
  mutable Mutex mutex_;
  std::deque<PartOrder> orders_ ORCA_GUARDED_BY(mutex_);
  std::optional<Status> end_;  // once it is closed; it does not change any more
};

}  // namespace orca::host
