// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/exit_reason.hpp"

#include "orca/base/system/signal_name.hpp"

namespace orca::supervisor {

std::string ExitReason::text() const {
  switch (force) {
    case Force::hang: return "hung and was killed";
    case Force::channel: return "broke its control channel and was killed";
    case Force::memory: return "used more memory than the graph allows and was killed";
    case Force::refused: return "could not come up and was ended";
    case Force::overdue: return "did not end when asked to and was killed";
    case Force::none: break;
  }
  if (is_guess) return status == 0 ? "ended as it had said" : "ended, and its new supervisor cannot tell how";
  if (signal == 0) return "exited with status " + std::to_string(status);
  std::string text = "was ended by SIG" + signal_name(signal);
  if (dumped_core) text += " (core dumped)";
  if (out_of_memory) text += " (the system has probably run out of memory)";
  return text;
}

}  // namespace orca::supervisor
