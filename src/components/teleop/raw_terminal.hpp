// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>
#include <termios.h>

namespace orca::teleop {

/// A terminal that delivers each key at once and echoes none while this object lives. Ctrl-C stays a signal.
///
/// A terminal left in this state is useless to its owner. So a small process (a shell) waits for the end of
/// this process and restores the settings with stty if this process could not: after a crash, or kill -9.
///
/// It does nothing if the descriptor is not a terminal (a pipe, a file).
///
/// Thread contract: not synchronised.
class RawTerminal {
 public:
  explicit RawTerminal(int fd);
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

 private:
  void start_guard();

  const int fd_;
  bool changed_ = false;
  termios before_{};
  pid_t guard_ = -1;
  int alive_ = -1;  // write end of the pipe by which the guard notices the end of this process
};

}  // namespace orca::teleop
