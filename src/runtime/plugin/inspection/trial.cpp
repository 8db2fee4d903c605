// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trial.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>

#include "orca/base/activity.hpp"
#include "orca/base/exception_text.hpp"
#include "orca/base/exhaustion.hpp"

namespace orca::plugin {
namespace {

using Step = std::function<void(const std::string&)>;
using Attempt = std::function<void(const Step&)>;

constexpr const char* kSurvived = "survived";
constexpr int kSignals[] = {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGSYS, SIGTRAP};

int g_report_fd = -1;  // in the copy only

// Writes a line to the parent. The last line shows how far the copy came.
void report(const std::string& line) {
  const std::string text = line + "\n";
  if (write(g_report_fd, text.data(), text.size()) < 0) _exit(1);  // the parent waits no longer
}

void report_terminate() {
  if (std::current_exception() != nullptr) {
    try {
      throw;
    } catch (...) {
      report("!" + describe_current_exception());
    }
  }
  _exit(1);
}

[[noreturn]] void run_copy(int report_fd, const Attempt& attempt) {
  g_report_fd = report_fd;
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // however the parent ends, the copy does not outlive it
  for (const int signal : kSignals) ::signal(signal, SIG_DFL);
  std::set_terminate(report_terminate);
  const int null = open("/dev/null", O_RDWR);  // the copy must not talk to the user
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, fd);
  try {
    attempt(report);
  } catch (...) {  // the real attempt will report the exception
  }
  report(kSurvived);
  _exit(0);
}

struct Ending {
  std::string last_step;
  std::string thrown;
  bool survived = false;
};

// Reads the copy's output up to its end; false if the copy is still running at the deadline.
bool read_all(int fd, Duration limit, std::string& text) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd input{fd, POLLIN, 0};
    const int ready = poll(&input, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    char buffer[512];
    const ssize_t count = read(fd, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    text.append(buffer, static_cast<std::size_t>(count));
    if (text.ends_with(std::string(kSurvived) + "\n")) return true;  // its child processes may live on
  }
}

Ending ending_of(const std::string& text) {
  Ending ending;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    if (line == kSurvived) {
      ending.survived = true;
    } else if (line.starts_with("!")) {
      ending.thrown = line.substr(1);
    } else {
      ending.last_step = line;
    }
    at = end + 1;
  }
  return ending;
}

std::string how_it_ended(int status, const std::string& thrown) {
  if (!thrown.empty()) return thrown + ", which nothing can catch there";
  if (WIFSIGNALED(status))
    return std::string("ended the process with the signal ") + sigabbrev_np(WTERMSIG(status)) + " (" +
           strsignal(WTERMSIG(status)) + ")";
  return "ended the process with exit(" + std::to_string(WEXITSTATUS(status)) + ")";
}

Error cannot_try(int reason) {
  throw_if_exhausted(reason);
  return fail(Code::unavailable, std::string("cannot try it out: ") + std::strerror(reason));
}

}  // namespace

Status survives_trial(const Attempt& attempt, Duration limit) {
  int fds[2];
  if (pipe2(fds, O_CLOEXEC) != 0) return cannot_try(errno);
  ActivityKeeper here;
  here.keep();
  ActivityKeeper().restore();  // this fork() must not count as a plugin's
  const pid_t copy = fork();
  const int reason = errno;
  if (copy == 0) run_copy(fds[1], attempt);
  here.restore();
  close(fds[1]);
  std::string text;
  const bool ended = copy > 0 && read_all(fds[0], limit, text);
  close(fds[0]);
  if (copy < 0) return cannot_try(reason);
  const Ending ending = ending_of(text);
  if (!ended || ending.survived) kill(copy, SIGKILL);
  int status = 0;
  while (waitpid(copy, &status, 0) < 0 && errno == EINTR) {
  }
  if (!ended)
    return fail(Code::deadline_exceeded,
                ending.last_step + " did not return within " +
                    std::to_string(std::chrono::duration_cast<std::chrono::seconds>(limit).count()) + " s");
  if (ending.survived) return ok();
  return fail(Code::internal, ending.last_step + " " + how_it_ended(status, ending.thrown));
}

}  // namespace orca::plugin
