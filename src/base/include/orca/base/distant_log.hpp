// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>

#include "orca/base/log.hpp"

namespace orca::log {

/// Hears the lines that other processes of the run write to the log, while it lives. Those of this process come to a
/// Listener.
class DistantListener {
 public:
  /// @param heard  is called with each line, for one line at a time, on any thread. It must not write to the log itself.
  explicit DistantListener(std::function<void(const Line&)> heard);
  /// After it no call is under way.
  ~DistantListener();
  DistantListener(const DistantListener&) = delete;
  DistantListener& operator=(const DistantListener&) = delete;

 private:
  friend void hear_distant(const Line& line);
  std::function<void(const Line&)> heard_;
};

/// Returns whether anybody in this process wants the lines of others.
/// @thread  any.
[[nodiscard]] bool wants_distant();

/// Passes a line of another process to those who want it.
/// @thread  any.
void hear_distant(const Line& line);

}  // namespace orca::log
