// SPDX-License-Identifier: LGPL-3.0-or-later
#include "raw_terminal.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <string>

namespace orca::teleop {
namespace {

// The guard: its input is the pipe, its descriptor 3 the terminal. A line on the pipe says that the terminal
// is restored; without one the guard restores it.
constexpr const char* kGuard = R"(read -r restored || exec stty "$0" <&3)";
constexpr char kRestored[] = "restored\n";
constexpr int kOutOfTheWay = 10;

void add_number(std::string& text, unsigned long number) {
  std::array<char, 2 * sizeof number> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number, 16).ptr;
  if (!text.empty()) text += ':';
  text.append(digits.data(), end);
}

// Returns terminal settings in the form that `stty -g` prints and stty accepts.
std::string text_of(const termios& settings) {
  std::string text;
  for (const tcflag_t flags : {settings.c_iflag, settings.c_oflag, settings.c_cflag, settings.c_lflag})
    add_number(text, flags);
  for (const cc_t character : settings.c_cc) add_number(text, character);
  return text;
}

// The state in which the guard starts. It has only two of this process's descriptors, so that readers of this
// process's pipes do not wait for the guard. It is in its own process group and blocks the signals that end
// this process.
class Beginning {
 public:
  Beginning(int end_of_pipe, int terminal) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, end_of_pipe, 0);
    posix_spawn_file_actions_adddup2(&files_, terminal, 3);
    posix_spawn_file_actions_addopen(&files_, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files_, 2, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&files_, 4);
    posix_spawnattr_init(&attributes_);
    sigset_t deaf_to;
    sigemptyset(&deaf_to);
    for (const int signal : {SIGINT, SIGQUIT, SIGHUP, SIGTERM, SIGTSTP, SIGTTOU, SIGTTIN})
      sigaddset(&deaf_to, signal);
    posix_spawnattr_setsigmask(&attributes_, &deaf_to);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  }
  ~Beginning() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  Beginning(const Beginning&) = delete;
  Beginning& operator=(const Beginning&) = delete;

  // Starts a shell and returns its process id, -1 on failure. It avoids fork(), because a copy of a process
  // with threads is fragile.
  [[nodiscard]] pid_t shell(std::string script, std::string argument) const {
    std::string name = "sh";
    std::string option = "-c";
    const std::array<char*, 5> words{name.data(), option.data(), script.data(), argument.data(), nullptr};
    pid_t process = -1;
    return posix_spawn(&process, "/bin/sh", &files_, &attributes_, words.data(), environ) == 0 ? process : -1;
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

}  // namespace

RawTerminal::RawTerminal(int fd) : fd_(fd) {
  if (tcgetattr(fd_, &before_) != 0) return;  // not a terminal
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
  // After this line the guard leaves the terminal alone, which may belong to another process by then.
  if (write(alive_, kRestored, sizeof kRestored - 1) < 0) kill(guard_, SIGKILL);
  close(alive_);
  while (waitpid(guard_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void RawTerminal::start_guard() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return;
  const int terminal = fcntl(fd_, F_DUPFD_CLOEXEC, kOutOfTheWay);
  if (terminal >= 0) guard_ = Beginning(ends[0], terminal).shell(kGuard, text_of(before_));
  close(terminal);
  close(ends[0]);
  alive_ = ends[1];
  if (guard_ > 0) return;
  close(alive_);
  alive_ = -1;
}

}  // namespace orca::teleop
