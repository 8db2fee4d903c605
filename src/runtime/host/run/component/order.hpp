// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <utility>

#include "orca/base/result.hpp"

namespace orca::host {

/// A request to one component from outside. It is carried out on the component's strand, between laps.
///
/// Thread contract: done() from anywhere, result() after it; the rest on the component's strand.
class Order {
 public:
  explicit Order(std::function<Status()> body) : body_(std::move(body)) {}

  void carry_out() { conclude(body_()); }
  void refuse(Error reason) { conclude(std::move(reason)); }

  [[nodiscard]] bool done() const { return done_.load(std::memory_order_acquire); }
  [[nodiscard]] const Status& result() const { return result_; }

 private:
  void conclude(Status result) {
    result_ = std::move(result);
    done_.store(true, std::memory_order_release);
  }

  std::function<Status()> body_;
  Status result_;
  std::atomic<bool> done_{false};
};

}  // namespace orca::host
