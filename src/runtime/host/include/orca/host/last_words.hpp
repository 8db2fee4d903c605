// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca::host {

/// The last line of a process that dies of a plugin, on stderr: which component, which hook, which plugin,
/// what happened. It prevents nothing: a signal or an exception that nobody may catch still ends the process
/// as it would without this, exit() in a plugin ends it with another status, and the robot is stopped by its
/// watchdogs. If a plugin calls fork(), the copy is ended, because a second robot program must not run.
///
/// Nobody can see _exit(), SIGKILL, and a process whose memory is beyond use.
///
/// Thread contract: one object per process, made first and destroyed last by the main thread.
class LastWords {
 public:
  /// @param exit_status  of a process that a plugin tries to end by exit(), or has made unusable.
  explicit LastWords(int exit_status);
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;

  /// Gives the calling thread a stack to report from when its own has overflowed. Once per thread does it.
  static void prepare_thread();

  /// Writes a line to what was stderr when this was made, and ends the process with the exit status given
  /// there.
  [[noreturn]] static void say_and_end(const std::string& line);
};

}  // namespace orca::host
