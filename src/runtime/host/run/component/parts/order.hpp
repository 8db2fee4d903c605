// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <utility>

#include "orca/base/result.hpp"

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

}  // namespace orca::host
