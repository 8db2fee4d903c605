// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca::host {

/// Sees to it that a process that dies of a plugin says so on stderr first: which component, which hook,
/// which plugin, what happened. It prevents nothing: a signal or an exception that nobody may catch still
/// ends the process as it would without this, exit() in a plugin ends it with status 1, and the robot is
/// stopped by its watchdogs. Of fork() in a plugin it ends the copy, because a second robot program must not
/// run.
///
/// What nobody can see: _exit(), SIGKILL, and a process whose memory is beyond use.
///
/// Thread contract: one object per process, made first and destroyed last by the main thread.
class LastWords {
 public:
  LastWords();
  ~LastWords();
  LastWords(const LastWords&) = delete;
  LastWords& operator=(const LastWords&) = delete;

  /// Gives the calling thread a stack to report from when its own has overflowed. Once per thread does it.
  static void prepare_thread();

  /// Writes a line to what was stderr when this was made, and ends the process with status 1.
  [[noreturn]] static void say_and_end(const std::string& line);
};

}  // namespace orca::host
