// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/host_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>

#include "orca/supervisor/vocabulary.hpp"
#include "processes/launch.hpp"
#include "processes/line_splitter.hpp"

namespace orca::supervisor {
namespace {

constexpr std::size_t kReadAtOnce = 64 * 1024;  // [bytes]
constexpr int kKillMs = 1000;                   // longest wait for a process that was killed

// Returns how many processes the system has killed since it started because memory ran out; 0 if it does not tell.
std::uint64_t oom_kills() {
  std::ifstream statistics("/proc/vmstat");
  std::string name;
  std::uint64_t count = 0;
  while (statistics >> name >> count)
    if (name == "oom_kill") return count;
  return 0;
}

}  // namespace

struct HostProcess::Parts {
  std::string name;
  Launched launched;
  Descriptor channel;
};

Result<std::unique_ptr<HostProcess>> HostProcess::start(const HostStart& start) {
  auto sockets = make_socket_pair();
  if (!sockets) return sockets.error();
  auto launched = launch(start, sockets->host);
  if (!launched) return launched.error();
  Parts parts{start.name, std::move(*launched), std::move(sockets->supervisor)};
  return std::unique_ptr<HostProcess>(new HostProcess(std::move(parts)));
}

std::unique_ptr<HostProcess> HostProcess::adopt(AdoptedProcess process) {
  Launched running{process.pid, std::move(process.pidfd), std::move(process.output), {}};
  Parts parts{std::move(process.name), std::move(running), std::move(process.channel)};
  return std::unique_ptr<HostProcess>(new HostProcess(std::move(parts)));
}

std::unique_ptr<HostProcess> HostProcess::here(std::string name, Descriptor channel) {
  return adopt(
      {std::move(name), getpid(), {}, {}, std::move(channel)});  // without a pidfd nobody can signal it
}

HostProcess::HostProcess(Parts parts)
    : name_(std::move(parts.name)),
      pid_(parts.launched.pid),
      pidfd_(std::move(parts.launched.pidfd)),
      output_(std::move(parts.launched.output)),
      channel_(std::move(parts.channel)),
      warnings_(std::move(parts.launched.warnings)),
      lines_(std::make_unique<LineSplitter>()),
      oom_kills_before_(oom_kills()) {}

HostProcess::~HostProcess() {
  if (!pidfd_ || exit()) return;
  send(SIGKILL);
  pollfd end{pidfd_.number(), POLLIN, 0};
  poll(&end, 1, kKillMs);
  (void)exit();
}

void HostProcess::send(int signal) const {
  if (!exit_) syscall(SYS_pidfd_send_signal, pidfd_.number(), signal, nullptr, 0);
}

std::vector<std::string> HostProcess::take_output() {
  std::array<char, kReadAtOnce> buffer;
  const ssize_t size = output_ ? read(output_.number(), buffer.data(), buffer.size()) : -1;
  if (size > 0) return lines_->add(std::string_view(buffer.data(), static_cast<std::size_t>(size)));
  // A child of the process may keep the pipe open for ever.
  const bool is_over = size == 0 || (output_ && errno == EAGAIN && exit());
  if (!is_over) return {};
  output_.reset();
  return lines_->finish();
}

std::string HostProcess::take_unfinished_line() {
  const std::vector<std::string> rest = lines_->finish();
  return rest.empty() ? "" : rest.front();
}

void HostProcess::end(Moment now, const EndLimits& limits, std::uint64_t request, bool keeps_states) {
  const bool is_asked = kill_at_.has_value();
  const Moment term_at = now + limits.when_asked;
  if (exit_ || (is_asked && (!term_at_ || *term_at_ <= term_at))) return;
  term_at_ = term_at;
  kill_at_ = term_at + limits.when_terminated;
  // A process that takes no order gets the signal at once.
  if (!is_asked && !channel_.post(encode(TakeDown{keeps_states}, request)).ok()) term_at_ = now;
  look(now);
}

void HostProcess::end_by_force(Force reason, Moment now, Duration grace) {
  if (exit_ || force_ != Force::none) return;
  force_ = reason;
  term_at_ = now;
  kill_at_ = now + grace;
  look(now);
}

void HostProcess::look(Moment now) {
  if (exit_) return;
  if (term_at_ && now >= *term_at_) {
    send(SIGTERM);
    term_at_.reset();
  }
  if (kill_at_ && now >= *kill_at_) {
    if (force_ == Force::none) force_ = Force::overdue;
    send(SIGKILL);
    kill_at_ = Moment::max();  // it is still being ended
  }
}

std::optional<Moment> HostProcess::due() const {
  if (exit_) return std::nullopt;
  if (term_at_) return term_at_;
  return kill_at_ == Moment::max() ? std::nullopt : kill_at_;
}

const std::optional<ExitReason>& HostProcess::exit() {
  if (!exit_) exit_ = look_for_end();
  return exit_;
}

std::optional<ExitReason> HostProcess::look_for_end() const {
  siginfo_t end{};
  if (waitid(P_PIDFD, static_cast<id_t>(pidfd_.number()), &end, WEXITED | WNOHANG) != 0)
    return errno == ECHILD ? guess_end() : std::nullopt;
  if (end.si_pid == 0) return std::nullopt;
  ExitReason reason;
  reason.force = force_;
  const bool was_terminated = kill_at_ && !term_at_;
  if (end.si_code != CLD_EXITED && end.si_status == SIGTERM && was_terminated && force_ == Force::none)
    reason.force = Force::overdue;
  if (end.si_code == CLD_EXITED) {
    reason.status = end.si_status;
  } else {
    reason.signal = end.si_status;
    reason.dumped_core = end.si_code == CLD_DUMPED;
    reason.out_of_memory =
        reason.signal == SIGKILL && force_ == Force::none && oom_kills() > oom_kills_before_;
  }
  return reason;
}

// Only its parent learns how a process has ended.
std::optional<ExitReason> HostProcess::guess_end() const {
  pollfd end{pidfd_.number(), POLLIN, 0};
  if (poll(&end, 1, 0) != 1) return std::nullopt;
  ExitReason reason;
  reason.status = is_leaving_ ? 0 : 1;
  reason.force = force_;
  reason.is_guess = true;
  return reason;
}

bool HostProcess::is_dying() const {
  constexpr unsigned long kExiting = 0x4, kEndedBySignal = 0x400;  // PF_EXITING, PF_SIGNALED of the kernel
  std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return false;  // Nobody can know; if it has ended, nobody can end it.
  std::istringstream values(line.substr(line.rfind(')') + 1));  // the name may hold any character
  std::string skipped;
  unsigned long flags = 0, pending = 0;
  for (int field = 3; field < 9; ++field) values >> skipped;
  values >> flags;
  for (int field = 10; field < 31; ++field) values >> skipped;
  values >> pending;
  return (flags & (kExiting | kEndedBySignal)) != 0 || (pending >> (SIGKILL - 1) & 1U) != 0;
}

Descriptor HostProcess::share_output() const {
  return Descriptor(output_ ? fcntl(output_.number(), F_DUPFD_CLOEXEC, 0) : -1);
}

Duration HostProcess::waited_for_processor() {
  if (!wait_) wait_.emplace(pid_, find_thread(pid_, "orders"));
  return wait_->look();
}

std::optional<std::uint64_t> HostProcess::memory() const {
  std::ifstream statistics("/proc/" + std::to_string(pid_) + "/statm");
  std::uint64_t total = 0, resident = 0, shared = 0;
  if (!(statistics >> total >> resident >> shared) || resident == 0) return std::nullopt;
  return (resident - std::min(resident, shared)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace orca::supervisor
