// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

namespace orca::detail {

/// A function that can be left and entered again: a fiber or a thread that runs only while it holds the
/// baton.
///
/// Thread contract: resume() from the scheduler, suspend() from inside; never both at once.
class Context {
 public:
  virtual ~Context() = default;
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Runs the function until it suspends itself or ends.
  virtual void resume() = 0;

  /// Leaves the function; returns when it is resumed.
  virtual void suspend() = 0;
};

/// Makes contexts of one kind. `body` must not throw.
using ContextFactory = std::unique_ptr<Context> (*)(std::function<void()> body);

std::unique_ptr<Context> make_fiber_context(std::function<void()> body);
std::unique_ptr<Context> make_baton_context(std::function<void()> body);

}  // namespace orca::detail
