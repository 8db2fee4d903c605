// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>
#include <termios.h>

namespace orca::teleop {

/// A terminal that hands out each key at once and shows none, for as long as this lives. Ctrl-C stays a
/// signal.
///
/// A terminal left like that is useless to its owner, so a small process of our own waits for our end and
/// puts the settings back when this process could not: after a crash, or kill -9.
///
/// Does nothing to what is no terminal (a pipe, a file). Thread contract: not synchronised.
class RawTerminal {
 public:
  explicit RawTerminal(int fd);
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

 private:
  void start_guard();
  [[noreturn]] void guard(int end_of_pipe) const;

  const int fd_;
  bool changed_ = false;
  termios before_{};
  pid_t guard_ = -1;
  int alive_ = -1;  // our end of the pipe by which the guard sees our end
};

}  // namespace orca::teleop
