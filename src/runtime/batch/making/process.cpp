// SPDX-License-Identifier: LGPL-3.0-or-later
#include "process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/system/signal_name.hpp"
#include "orca/base/time.hpp"
#include "worker.hpp"

namespace orca::batch {
namespace {

double since(RunProcess::Clock::time_point time) {
  return std::chrono::duration<double>(RunProcess::Clock::now() - time).count();
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

constexpr double kShortestOverload = 5.0;  // [s]

std::string reason_of(int status) {
  if (WIFSIGNALED(status)) return "its process died of SIG" + signal_name(WTERMSIG(status));
  return "its process ended with status " + std::to_string(WEXITSTATUS(status)) + " and no result";
}

// Silences the process: output of a component is no result, and nobody types for it.
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

Result<RunProcess> RunProcess::start(const std::function<void(int)>& work, double limit) {
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
  return RunProcess(pid, ends[0], limit);
}

RunProcess::RunProcess(RunProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, 0)),
      from_(std::exchange(other.from_, -1)),
      limit_(other.limit_),
      started_(other.started_),
      wait_(other.wait_),
      was_killed_(other.was_killed_),
      text_(std::move(other.text_)) {}

RunProcess& RunProcess::operator=(RunProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(from_, other.from_);
  std::swap(limit_, other.limit_);
  std::swap(started_, other.started_);
  std::swap(wait_, other.wait_);
  std::swap(was_killed_, other.was_killed_);
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
  cost.wall = since(started_);
  cost.cpu = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return status;
}

RunProcess::Lateness RunProcess::lateness() {
  const double taken = since(started_);
  const double waited = to_seconds(wait_.look());
  if (taken < limit_) return Lateness::none;
  if (taken - waited >= limit_) return Lateness::hang;
  return waited >= std::max(limit_, kShortestOverload) ? Lateness::overload : Lateness::none;
}

void RunProcess::kill_late(Cost& cost) {
  kill(pid_, SIGKILL);
  (void)wait(cost);
}

Outcome RunProcess::outcome(Cost& cost) {
  const int status = wait(cost);
  was_killed_ = WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
  const std::size_t end = std::min(text_.find(kLapsFollow), text_.size());
  std::optional<Outcome> read = read_outcome(std::string_view(text_).substr(0, end));
  if (end < text_.size())
    cost.laps = read_laps(std::string_view(text_).substr(end + 1)).value_or(std::vector<LapCost>{});
  const bool is_good = read && WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS;
  return is_good ? *std::move(read)
                 : Outcome{.ending = Ending::crash, .reason = reason_of(status), .failure = Failure::crash};
}

}  // namespace orca::batch
