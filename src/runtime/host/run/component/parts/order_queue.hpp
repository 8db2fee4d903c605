// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "orca/base/strand.hpp"
#include "order.hpp"

namespace orca::host {

/// The orders that were given to one component and are not carried out yet, oldest first.
///
/// Thread contract: add() and waits() from anywhere, the rest on the component's strand.
class OrderQueue {
 public:
  /// @param strand  the component's strand, which is woken when an order comes.
  explicit OrderQueue(Strand& strand) : strand_(strand) {}

  /// Adds an order. After refuse_all() the order is refused at once.
  /// @param body  carries it out, on the strand.
  std::shared_ptr<Order> add(std::function<Status()> body);
  /// Returns whether an order waits.
  [[nodiscard]] bool waits() const { return waits_.load(std::memory_order_acquire); }

  /// Carries out the oldest order.
  /// @return false if there is none.
  bool carry_out_next();
  /// Refuses the waiting orders and all later ones, because the component has ended.
  void refuse_all();

 private:
  [[nodiscard]] std::shared_ptr<Order> take_next();
  [[nodiscard]] Error has_ended() const;

  Strand& strand_;
  std::atomic<bool> waits_{false};
  std::mutex mutex_;
  std::deque<std::shared_ptr<Order>> orders_;
  bool open_ = true;
};

}  // namespace orca::host
