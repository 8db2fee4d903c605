// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca::supervisor {

/// Why the supervisor has ended a host process by force.
enum class Force {
  none,     ///< It has not.
  hang,     ///< Its heartbeat stood still, or it read no orders.
  channel,  ///< Its control channel was broken, or carried nonsense.
  memory,   ///< It used more memory than the graph allows.
  refused,  ///< It could not come up.
  overdue,  ///< It had not ended in time after it was asked to.
};

/// The way in which a host process ended. A plain value.
struct ExitReason {
  int status = 0;              ///< Its exit status; 0 if a signal ended it.
  int signal = 0;              ///< The signal that ended it; 0: it exited by itself.
  bool dumped_core = false;    ///< Whether the system wrote a core file.
  bool out_of_memory = false;  ///< Whether the system probably killed it because memory ran out.
  Force force = Force::none;
  /// Whether the system does not tell how it ended, because another supervisor had started it. Then status is 0 if the process
  /// has said that it ends, and 1 otherwise.
  bool is_guess = false;

  /// Returns whether it ended by itself with status 0.
  [[nodiscard]] bool is_normal() const { return force == Force::none && signal == 0 && status == 0; }
  /// Returns a text for people that goes on after the name of the process: "exited with status 1",
  /// "was ended by SIGSEGV (core dumped)", "hung and was killed".
  [[nodiscard]] std::string text() const;
};

}  // namespace orca::supervisor
