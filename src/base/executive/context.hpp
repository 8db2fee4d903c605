// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

namespace orca::detail {

/// A function that can be left and entered again: a fiber or a thread that runs only while it holds the
/// baton.
///
/// Thread contract: enter() from the scheduler, hand_over() from inside; never both at once.
class Context {
 public:
  virtual ~Context() = default;
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Runs this function, and those that it hands over to, until one of them ends.
  virtual void enter() = 0;

  /// Leaves this function and enters `next`, without a detour through the scheduler. Returns when this
  /// function is entered again.
  /// @pre  next comes from the same maker, has not ended, and is not this.
  virtual void hand_over(Context& next) = 0;
};

/// A factory of contexts of one kind, which can hand over to each other. It must outlive them.
class ContextMaker {
 public:
  virtual ~ContextMaker() = default;

  /// Returns whether all contexts run on the thread that enters them.
  [[nodiscard]] virtual bool share_a_thread() const = 0;

  /// @param body  must not throw.
  [[nodiscard]] virtual std::unique_ptr<Context> make(std::function<void()> body) = 0;
};

std::unique_ptr<ContextMaker> make_fiber_contexts();
std::unique_ptr<ContextMaker> make_baton_contexts();

}  // namespace orca::detail
