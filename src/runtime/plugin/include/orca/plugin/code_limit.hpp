// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <ctime>
#include <optional>

#include "orca/base/time.hpp"

namespace orca::plugin {

/// A limit on the time for which a plugin's code may keep the main thread of the program where nothing else can end it: while a
/// graph is checked, and when all is destroyed. At the limit the thread gets a signal, whose handler is to say what
/// hangs and to end the program if is_over(). Time in which the thread waits for a processor does not count.
///
/// Thread contract: made and destroyed by one thread. On other threads than the main one, in copies of the process and before
/// enforce() it does nothing.
class CodeLimit {
 public:
  CodeLimit();
  ~CodeLimit();
  CodeLimit(const CodeLimit&) = delete;
  CodeLimit& operator=(const CodeLimit&) = delete;

  /// Lets all later objects send the signal after the limit [s].
  /// @thread  the main one.
  static void enforce(int signal, Duration limit);

  /// Returns whether the limit is reached; if it is not, the signal comes again later. To be called by its handler, for the object that
  /// its value points to (siginfo_t::si_value).
  [[nodiscard]] bool is_over();

 private:
  std::optional<timer_t> timer_;
  Duration begun_{0};   // by the monotonic clock
  Duration waited_{0};  // for a processor, before it began
  bool asked_ = false;  // the signal has come once at the limit
};

}  // namespace orca::plugin
