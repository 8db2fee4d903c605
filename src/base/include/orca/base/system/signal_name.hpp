// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <signal.h>

#include <cstring>
#include <string>

namespace orca {

/// Returns the name of a signal without "SIG": "KILL", "RTMIN+3"; its number if it has no name. The C library has no name for
/// signals of real time, and for those that it keeps for itself.
/// @thread  pure function; any thread.
[[nodiscard]] inline std::string signal_name(int signal) {
  if (signal >= SIGRTMIN && signal <= SIGRTMAX) return "RTMIN+" + std::to_string(signal - SIGRTMIN);
  const char* const name = sigabbrev_np(signal);
  return name != nullptr ? name : std::to_string(signal);
}

}  // namespace orca
