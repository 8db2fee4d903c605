// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/host/swap.hpp"

namespace orca::host {

/// Handles a component that hangs where nothing else can help: it ends the process.
/// @param text  what hangs, for people.
using Standstill = std::function<void(const std::string& component, const std::string& text)>;

/// One exchange of code while the system runs, of a component or of a driver.
///
/// Thread contract: one task, the executive's main task.
class Exchange {
 public:
  virtual ~Exchange() = default;

  /// Begins it. Nothing has happened yet when it fails.
  virtual Status prepare() = 0;
  /// Goes on as far as possible. To be called whenever an instance has changed, and at wake_up(), until it returns the
  /// outcome. It does not block.
  /// @return the outcome when what is not needed any more is gone; nothing while that is to come.
  virtual std::optional<Result<SwapReport>> step() = 0;
  /// Ends the exchange as it is. @pre  the strands of what was to be exchanged have ended.
  /// @return the outcome: the reason why there is none.
  virtual Result<SwapReport> give_up() = 0;
  /// Returns when step() has something to do even if nothing changes.
  [[nodiscard]] virtual TimePoint wake_up() const = 0;
  /// Returns the name in the graph of what is exchanged.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// Returns whether an object that is not needed any more does not end. Its code runs, so this exchange must never be
  /// destroyed.
  [[nodiscard]] virtual bool is_stuck() const = 0;
};

}  // namespace orca::host
