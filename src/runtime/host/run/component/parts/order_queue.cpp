// SPDX-License-Identifier: LGPL-3.0-or-later
#include "order_queue.hpp"

#include <utility>

namespace orca::host {

std::shared_ptr<Order> OrderQueue::add(std::function<Status()> body) {
  auto order = std::make_shared<Order>(std::move(body));
  {
    const std::lock_guard lock(mutex_);
    if (open_) {
      orders_.push_back(order);
      waits_.store(true, std::memory_order_release);
    } else {
      order->refuse(has_ended());
    }
  }
  strand_.wake();
  return order;
}

bool OrderQueue::carry_out_next() {
  const std::shared_ptr<Order> order = take_next();
  if (order == nullptr) return false;
  order->carry_out();
  return true;
}

void OrderQueue::refuse_all() {
  const std::lock_guard lock(mutex_);
  open_ = false;
  for (const auto& order : orders_) order->refuse(has_ended());
  orders_.clear();
}

std::shared_ptr<Order> OrderQueue::take_next() {
  const std::lock_guard lock(mutex_);
  if (orders_.empty()) return nullptr;
  std::shared_ptr<Order> order = std::move(orders_.front());
  orders_.pop_front();
  waits_.store(!orders_.empty(), std::memory_order_release);
  return order;
}

Error OrderQueue::has_ended() const {
  return fail(Code::failed_precondition, "it has ended", strand_.name());
}

}  // namespace orca::host
