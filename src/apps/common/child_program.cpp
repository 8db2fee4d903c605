// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "common/child_program.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

namespace orca::apps {
namespace {

constexpr std::chrono::seconds kPatience{10};  // until the first line
constexpr std::chrono::milliseconds kLook{5};  // between two looks whether it has ended
constexpr std::chrono::seconds kEndLimit{5};   // then it is killed
constexpr int kSignalled = 128;
constexpr int kUnknown = 127;  // the system has thrown the status away, as where SIGCHLD is ignored

// Returns the present environment, in which programs are looked for beside this one first.
std::vector<std::string> environment() {
  const std::string own = std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
  const char* const path = std::getenv("PATH");
  std::vector<std::string> all{"PATH=" + own + (path == nullptr ? "" : ":" + std::string(path))};
  for (char** one = environ; *one != nullptr; ++one)
    if (!std::string(*one).starts_with("PATH=")) all.emplace_back(*one);
  return all;
}

// Returns texts as execvp() wants them.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

struct Becoming {
  const char* folder;
  char* const* words;
  char* const* variables;
  int output;  // -1: that of this process
  bool with_errors;
  pid_t parent;
};

// The child: only system calls.
[[noreturn]] void become(const Becoming& what) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != what.parent) _exit(1);  // it was killed before
  for (int number = 1; number < NSIG; ++number) signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  setpgid(0, 0);  // Ctrl-C in the terminal ends the parent, which ends this
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
  if (what.output >= 0) dup2(what.output, STDOUT_FILENO);
  if (what.with_errors) dup2(what.output, STDERR_FILENO);
  environ = const_cast<char**>(what.variables);
  if (chdir(what.folder) == 0) execvp(what.words[0], what.words);
  _exit(127);
}

int exit_status_of(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : kSignalled + WTERMSIG(status);
}

}  // namespace

Result<ChildProgram> ChildProgram::start(const std::vector<std::string>& words, Reads reads,
                                         const std::string& folder) {
  std::vector<std::string> all = words;
  std::vector<std::string> variables = environment();
  const std::vector<char*> word_pointers = pointers_to(all);
  const std::vector<char*> variable_pointers = pointers_to(variables);
  Descriptor input;
  Descriptor output;
  if (int ends[2]; reads != Reads::nothing) {
    if (pipe2(ends, O_CLOEXEC) != 0) return fail(Code::unavailable, "there is no pipe for it", words.front());
    input = Descriptor(ends[0]);
    output = Descriptor(ends[1]);
  }
  sigset_t every;
  sigset_t before;
  sigfillset(&every);
  pthread_sigmask(SIG_SETMASK, &every,
                  &before);  // a signal for the child must not find this program's handlers
  const pid_t self = getpid();
  const pid_t process = fork();
  if (process == 0)
    become({folder.c_str(), word_pointers.data(), variable_pointers.data(), output.number(),
            reads == Reads::everything, self});
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (process < 0) return fail(Code::unavailable, "it cannot be started", words.front());
  return ChildProgram(process, std::move(input));
}

std::string ChildProgram::first_line() const {
  std::string line;
  const auto limit = std::chrono::steady_clock::now() + kPatience;
  for (pollfd waits{output_.number(), POLLIN, 0};;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(limit - std::chrono::steady_clock::now());
    const int ready = left.count() <= 0 ? 0 : poll(&waits, 1, static_cast<int>(left.count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready != 1) return {};
    char letter = '\0';
    if (read(output_.number(), &letter, 1) != 1 || letter == '\n') return line;
    line += letter;
  }
}

std::optional<int> ChildProgram::ended() {
  int status = 0;
  const pid_t found = process_ == 0 ? 0 : waitpid(process_, &status, WNOHANG);
  if (found == 0 || (found < 0 && errno == EINTR)) return status_;
  process_ = 0;
  status_ = found < 0 ? kUnknown : exit_status_of(status);
  return status_;
}

int ChildProgram::wait() {
  output_.reset();  // it may wait for somebody to read what it prints
  while (!ended()) std::this_thread::sleep_for(kLook);
  return *status_;
}

int ChildProgram::end() {
  if (process_ != 0 && !ended()) kill(process_, SIGTERM);
  output_.reset();  // it may wait for somebody to read what it prints
  const auto limit = std::chrono::steady_clock::now() + kEndLimit;
  while (process_ != 0 && !ended()) {
    if (std::chrono::steady_clock::now() >= limit) kill(process_, SIGKILL);
    std::this_thread::sleep_for(kLook);
  }
  return status_.value_or(0);
}

std::string ending_text(int status) {
  return status > kSignalled ? "signal " + std::to_string(status - kSignalled)
                             : "exit status " + std::to_string(status);
}

}  // namespace orca::apps
