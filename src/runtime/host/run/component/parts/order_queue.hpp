// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "orca/base/result.hpp"
#include "orca/base/strand.hpp"

namespace orca::host {

/// A request to one component from outside. It is carried out on the component's strand, between laps.
///
/// Thread contract: done(), withdraw() and is_withdrawn() from anywhere, result() after done(); the rest on the component's strand.
class Order {
 public:
  explicit Order(std::function<Status()> body) : body_(std::move(body)) {}

  /// Carries it out, unless it was withdrawn.
  void carry_out() {
    if (leave_waiting(State::begun)) conclude(body_());
  }
  void refuse(Error reason) {
    if (leave_waiting(State::begun)) conclude(std::move(reason));
  }
  /// Takes it back; it is never carried out then, and never done.
  /// @return false if it is too late: it is being carried out, or is done.
  bool withdraw() { return leave_waiting(State::withdrawn); }

  [[nodiscard]] bool is_withdrawn() const {
    return state_.load(std::memory_order_acquire) == State::withdrawn;
  }
  [[nodiscard]] bool done() const { return state_.load(std::memory_order_acquire) == State::done; }
  [[nodiscard]] const Status& result() const { return result_; }

 private:
  enum class State { waiting, begun, withdrawn, done };

  bool leave_waiting(State next) {
    State expected = State::waiting;
    return state_.compare_exchange_strong(expected, next, std::memory_order_acq_rel);
  }
  void conclude(Status result) {
    result_ = std::move(result);
    state_.store(State::done, std::memory_order_release);
  }

  std::function<Status()> body_;
  Status result_;
  std::atomic<State> state_{State::waiting};
};

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
