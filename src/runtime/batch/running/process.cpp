// SPDX-License-Identifier: LGPL-3.0-or-later
#include "process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

namespace orca::batch {
namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::string reason_of(int status) {
  if (WIFSIGNALED(status)) {
    const char* const name = sigabbrev_np(WTERMSIG(status));
    return "its process died of SIG" + (name == nullptr ? std::to_string(WTERMSIG(status)) : name);
  }
  return "its process ended with status " + std::to_string(WEXITSTATUS(status)) + " and no result";
}

// What a component prints is no result, and nobody types for it.
void be_silent() {
  const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(null, STDIN_FILENO);
  dup2(null, STDOUT_FILENO);
}

[[noreturn]] void begin(pid_t parent, const std::function<void(int)>& work, int to) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);  // it has gone meanwhile
  setpgid(0, 0);                                 // Ctrl-C is for the parent
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  be_silent();
  work(to);
  _exit(EXIT_FAILURE);
}

}  // namespace

Result<RunProcess> RunProcess::start(std::size_t run, const std::function<void(int)>& work, double limit) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    return fail(Code::unavailable, std::string("there is no pipe for a run: ") + std::strerror(errno));
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid == 0) {
    close(ends[0]);
    begin(parent, work, ends[1]);
  }
  const int reason = errno;
  close(ends[1]);
  if (pid < 0) {
    close(ends[0]);
    return fail(Code::unavailable, std::string("no process can be started: ") + std::strerror(reason));
  }
  const auto time = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit));
  return RunProcess(run, pid, ends[0], Clock::now() + time);
}

RunProcess::RunProcess(RunProcess&& other) noexcept
    : run_(other.run_),
      pid_(std::exchange(other.pid_, 0)),
      from_(std::exchange(other.from_, -1)),
      deadline_(other.deadline_),
      started_(other.started_),
      text_(std::move(other.text_)) {}

RunProcess& RunProcess::operator=(RunProcess&& other) noexcept {
  std::swap(run_, other.run_);
  std::swap(pid_, other.pid_);
  std::swap(from_, other.from_);
  std::swap(deadline_, other.deadline_);
  std::swap(started_, other.started_);
  text_.swap(other.text_);
  return *this;
}

RunProcess::~RunProcess() {
  if (from_ >= 0) close(from_);
  if (pid_ == 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

bool RunProcess::read() {
  std::array<char, 4096> bytes{};
  const ssize_t count = ::read(from_, bytes.data(), bytes.size());
  if (count > 0) text_.append(bytes.data(), static_cast<std::size_t>(count));
  return count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN);
}

int RunProcess::wait(Cost& cost) {
  int status = 0;
  rusage usage{};
  while (wait4(pid_, &status, 0, &usage) < 0 && errno == EINTR) continue;
  pid_ = 0;
  cost.wall = std::chrono::duration<double>(Clock::now() - started_).count();
  cost.cpu = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return status;
}

Outcome RunProcess::kill_late(Cost& cost) {
  kill(pid_, SIGKILL);
  (void)wait(cost);
  return {.ending = Ending::hang, .reason = "it did not end within the limit of the experiment"};
}

Outcome RunProcess::outcome(Cost& cost) {
  const int status = wait(cost);
  std::optional<Outcome> read = read_outcome(text_);
  const bool is_good = read && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
  return is_good ? *std::move(read) : Outcome{.ending = Ending::crash, .reason = reason_of(status)};
}

}  // namespace orca::batch
