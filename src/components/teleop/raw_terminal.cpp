// SPDX-License-Identifier: LGPL-3.0-or-later
#include "raw_terminal.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <initializer_list>

namespace orca::teleop {
namespace {

constexpr char kRestored = 'r';

// Of the new process all but the terminal and the pipe: whoever waits for the end of our pipes and sockets
// must not wait for the guard.
void close_others(int one, int other) {
  const long most = sysconf(_SC_OPEN_MAX);
  for (int fd = 0; fd < (most > 0 && most < 4096 ? most : 4096); ++fd)
    if (fd != one && fd != other) close(fd);
}

}  // namespace

RawTerminal::RawTerminal(int fd) : fd_(fd) {
  if (tcgetattr(fd_, &before_) != 0) return;  // no terminal
  start_guard();
  termios raw = before_;
  raw.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  raw.c_cc[VMIN] = 1;
  raw.c_cc[VTIME] = 0;
  changed_ = tcsetattr(fd_, TCSANOW, &raw) == 0;
}

RawTerminal::~RawTerminal() {
  if (changed_) tcsetattr(fd_, TCSANOW, &before_);
  if (guard_ < 0) return;
  // Told so, the guard leaves the terminal alone, which may be another's by then.
  if (write(alive_, &kRestored, 1) < 0) kill(guard_, SIGKILL);
  close(alive_);
  while (waitpid(guard_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void RawTerminal::start_guard() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return;
  guard_ = fork();
  if (guard_ == 0) guard(ends[0]);
  close(ends[0]);
  alive_ = ends[1];
  if (guard_ > 0) return;
  close(alive_);
  alive_ = -1;
}

// The child of a process with threads: only what is async-signal-safe.
void RawTerminal::guard(int end_of_pipe) const {
  for (const int signal : {SIGINT, SIGQUIT, SIGHUP, SIGTERM, SIGTSTP, SIGTTOU, SIGTTIN, SIGPIPE})
    ::signal(signal, SIG_IGN);
  close_others(fd_, end_of_pipe);
  char word = 0;
  ssize_t got = 0;
  while ((got = read(end_of_pipe, &word, 1)) < 0 && errno == EINTR) {
  }
  if (got == 0) tcsetattr(fd_, TCSANOW, &before_);
  _exit(0);
}

}  // namespace orca::teleop
