// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca::host {

/// The last line of a process that dies of a plugin, on stderr: which component, which hook, which plugin,
/// what happened. It prevents nothing. A signal or an exception that nobody may catch still ends the process
/// in the same way, exit() in a plugin ends it with another status, and the watchdogs stop the robot. If a
/// plugin calls fork(), the copy is ended, because a second robot program must not run.
///
/// No line is written after _exit(), after SIGKILL, or when the process's memory is beyond use.
///
/// Thread contract: one object per process, made first and destroyed last by the main thread.
class LastWords {
 public:
  /// @param exit_status  status of a process that a plugin tries to end by exit(), or has made unusable.
  explicit LastWords(int exit_status);
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;

  /// Gives the calling thread a stack to report from after an overflow of its own. Needed once per thread.
  static void prepare_thread();

  /// Writes a line to the stderr of the time of construction, and ends the process with the exit status given
  /// to the constructor.
  [[noreturn]] static void say_and_end(const std::string& line);
};

}  // namespace orca::host
