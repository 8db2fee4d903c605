// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "companion.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "orca/base/descriptor.hpp"

namespace orca::deployer {
namespace {

constexpr int kPatienceMs = 10'000;            // until the first line
constexpr std::chrono::milliseconds kLook{5};  // between two looks whether it has ended
constexpr int kLooks = 1000;                   // then it is killed

// Returns the words as execv() wants them.
std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

// The child: only system calls.
[[noreturn]] void become(const char* program, char* const* words, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // it was killed before
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  setpgid(0, 0);  // Ctrl-C in the terminal is for the deployer, which ends it in the end
  dup2(output, STDOUT_FILENO);
  execv(program, words);
  _exit(1);
}

// Returns what comes until the end of a line, or of the patience, or of the program.
std::string read_line(int descriptor) {
  std::string line;
  for (pollfd waits{descriptor, POLLIN, 0}; poll(&waits, 1, kPatienceMs) == 1;) {
    char letter = '\0';
    if (read(descriptor, &letter, 1) != 1 || letter == '\n') break;
    line += letter;
  }
  return line;
}

}  // namespace

Result<Companion> Companion::start(const std::string& name, const std::vector<std::string>& words) {
  const std::string program = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / name).string();
  std::vector<std::string> all{name};
  all.insert(all.end(), words.begin(), words.end());
  const std::vector<char*> pointers = pointers_to(all);
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return fail(Code::unavailable, "there is no pipe for " + name);
  const Descriptor input(ends[0]);
  Descriptor output(ends[1]);
  const pid_t self = getpid();
  const pid_t process = fork();
  if (process == 0) become(program.c_str(), pointers.data(), output.number(), self);
  if (process < 0) return fail(Code::unavailable, name + " cannot be started");
  output.reset();
  Companion companion(process, read_line(input.number()));
  if (companion.first_line_.empty()) return fail(Code::unavailable, name + " has not started");
  return companion;
}

Companion::~Companion() {
  if (process_ == 0) return;
  kill(process_, SIGTERM);
  for (int look = 0; look < kLooks; ++look) {
    if (waitpid(process_, nullptr, WNOHANG) != 0) return;
    std::this_thread::sleep_for(kLook);
  }
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
}

}  // namespace orca::deployer
