// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/trial.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "inspection/effects.hpp"
#include "orca/base/activity.hpp"
#include "orca/base/exception_text.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/log_mute.hpp"
#include "orca/base/system/signal_name.hpp"

namespace orca::plugin {
namespace {

using Clock = std::chrono::steady_clock;
using Step = std::function<void(const std::string&)>;
using Ending = TrialResult::Ending;

constexpr int kSignals[] = {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGSYS, SIGTRAP};
// Out of the reach of code that closes descriptors which are not its own.
constexpr int kHighDescriptor = 500;

constexpr std::chrono::milliseconds kLook{50};  // between two questions whether to give up

constexpr const char* kEffectText = "would have left a trace outside its trial";

// The kinds of message from the copy: a kind, then a text with its length before it.
enum class Kind : char {
  step = 's',
  finding = 'f',
  question = 'q',
  thrown = 't',
  effect = 'e',
  impossible = 'i',
  end = 'w'
};

// --- In the copy ------------------------------------------------------------------------------------------

int g_report_fd = -1;

void read_all(char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t count = read(g_report_fd, data, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) _exit(1);  // the parent waits no longer
    data += count;
    size -= static_cast<std::size_t>(count);
  }
}

std::string read_answer() {
  std::uint32_t size = 0;
  read_all(reinterpret_cast<char*>(&size), sizeof size);
  std::string answer(size, '\0');
  read_all(answer.data(), size);
  return answer;
}

void write_all(const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = write(g_report_fd, data, size);
    if (written < 0 && errno != EINTR) _exit(1);  // the parent waits no longer
    if (written < 0) continue;
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

// Returns a text with its length before it.
std::string measured(const std::string& text) {
  const auto size = static_cast<std::uint32_t>(text.size());
  return std::string(reinterpret_cast<const char*>(&size), sizeof size) + text;
}

void report(Kind kind, const std::string& text) {
  const std::string record = static_cast<char>(kind) + measured(text);
  write_all(record.data(), record.size());
}

class Line final : public TrialLine {
 public:
  void step(const std::string& what) override { report(Kind::step, what); }
  void find(const std::string& finding) override { report(Kind::finding, finding); }
  std::string ask(const std::string& question) override {
    report(Kind::question, question);
    return read_answer();
  }
  [[noreturn]] void end() override {
    report(Kind::end, {});
    _exit(0);
  }
};

// Takes no memory.
void report_bare(Kind kind) {
  const char record[] = {static_cast<char>(kind), 0, 0, 0, 0};
  write_all(record, sizeof record);
}

void report_terminate() {
  if (std::current_exception() != nullptr) {
    try {
      throw;
    } catch (const std::bad_alloc&) {
      report_bare(Kind::impossible);  // without a text: it found no memory
      _exit(0);
    } catch (...) {
      report(Kind::thrown, describe_current_exception());
    }
  }
  _exit(1);
}

// Called in a signal handler.
void report_effect(int /*system_call*/) { report_bare(Kind::effect); }

// At exit() the leak checker of AddressSanitizer makes system calls that are forbidden here, and an exit() of the tried
// code would look like a trace. Does nothing in other builds.
void skip_leak_check() {
#if defined(__SANITIZE_ADDRESS__)
  on_exit([](int status, void* /*nothing*/) { _exit(status); }, nullptr);
#endif
}

// Whether what is written to a descriptor reaches somebody: other processes, devices, files. An image of a plugin is sealed.
bool leads_outside(int descriptor) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return false;
  const mode_t kind = status.st_mode & S_IFMT;
  if (kind == S_IFSOCK || kind == S_IFIFO) return true;
  if (kind == 0 || (fcntl(descriptor, F_GETFL) & O_ACCMODE) == O_RDONLY)
    return false;  // 0: an event, a timer
  const int seals = fcntl(descriptor, F_GET_SEALS);
  return seals < 0 || (seals & F_SEAL_WRITE) == 0;
}

// Lets what the copy has inherited lead nowhere, with the same numbers: code that writes to descriptors which are not its own must not
// reach the processes and devices of the running system.
void cut_off_descriptors(int null) {
  std::vector<int> outside;
  std::error_code unused;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", unused)) {
    const int descriptor = std::atoi(entry.path().filename().c_str());
    if (descriptor > STDERR_FILENO && descriptor != g_report_fd && leads_outside(descriptor))
      outside.push_back(descriptor);
  }
  for (const int descriptor : outside) dup3(null, descriptor, O_CLOEXEC);
}

[[noreturn]] void run_copy(int report_fd, const std::function<void(TrialLine&)>& attempt, Effects effects) {
  const int high = fcntl(report_fd, F_DUPFD_CLOEXEC, kHighDescriptor);
  g_report_fd = high < 0 ? report_fd : high;
  log::mute();
  for (const int signal : kSignals) ::signal(signal, SIG_DFL);
  std::set_terminate(report_terminate);
  const int null = open("/dev/null", O_RDWR);  // the copy must not talk to the user
  for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, fd);
  cut_off_descriptors(null);
  Line line;
  if (effects == Effects::none) skip_leak_check();
  if (effects == Effects::none && !forbid_effects(report_effect)) {
    report(Kind::impossible, "the system offers no way to forbid system calls (seccomp)");
    _exit(0);
  }
  try {
    attempt(line);
  } catch (...) {  // the real attempt will report the exception
  }
  line.end();
}

// --- In the process that waits ----------------------------------------------------------------------------

// The records that have come from the copy so far.
class Heard {
 public:
  TrialResult result;
  std::string thrown;
  bool over = false;  // the copy has said its last word

  /// @param ask  takes what the copy asks.
  explicit Heard(std::function<void(const std::string&)> ask) : ask_(std::move(ask)) {}

  void add(const char* data, std::size_t size) {
    bytes_.append(data, size);
    while (!over && take_record()) {
    }
  }

 private:
  bool take_record() {
    std::uint32_t size = 0;
    constexpr std::size_t kHead = 1 + sizeof size;
    if (bytes_.size() < kHead) return false;
    std::memcpy(&size, bytes_.data() + 1, sizeof size);
    if (bytes_.size() - kHead < size) return false;
    handle(static_cast<Kind>(bytes_.front()), bytes_.substr(kHead, size));
    bytes_.erase(0, kHead + size);
    return true;
  }

  void handle(Kind kind, std::string text) {
    switch (kind) {
      case Kind::step: result.last_step = std::move(text); return;
      case Kind::finding: result.findings.push_back(std::move(text)); return;
      case Kind::question: return ask_(text);
      case Kind::thrown: thrown = std::move(text); return;
      case Kind::effect: return end(Ending::effect, kEffectText);
      case Kind::impossible: return end(Ending::silent, text.empty() ? kNoMemoryText : std::move(text));
      case Kind::end: return end(Ending::well, {});
    }
  }

  void end(Ending ending, std::string text) {
    over = true;
    result.ending = ending;
    result.text = std::move(text);
  }

  const std::function<void(const std::string&)> ask_;
  std::string bytes_;
};

// Whoever waits for the copy, and for how long.
struct Patience {
  Clock::time_point deadline;
  const std::function<bool()>& give_up;

  [[nodiscard]] bool given_up() const { return give_up && give_up(); }
};

// Hears the copy out; false if it is still running when the patience is over.
bool hear_out(int fd, const Patience& patience, Heard& heard) {
  using std::chrono::milliseconds;
  while (!heard.over) {
    const auto left = std::chrono::ceil<milliseconds>(patience.deadline - Clock::now());
    pollfd input{fd, POLLIN, 0};
    const int ready = poll(&input, 1, static_cast<int>(std::clamp(left, milliseconds(0), kLook).count()));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0 && (left <= kLook || patience.given_up())) return false;
    if (ready <= 0) continue;
    char buffer[512];
    const ssize_t count = read(fd, buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return true;
    heard.add(buffer, static_cast<std::size_t>(count));
  }
  return true;
}

// Waits for the copy's end; false if it is still running at the deadline.
bool has_ended(pid_t copy, Clock::time_point deadline, int& status) {
  using namespace std::chrono_literals;
  for (;;) {
    const pid_t ended = waitpid(copy, &status, WNOHANG);
    if (ended == copy || (ended < 0 && errno != EINTR)) return true;
    if (ended == 0 && Clock::now() >= deadline) return false;
    std::this_thread::sleep_for(1ms);
  }
}

// Answers a question of the copy, which does not have that time for its own.
void answer_copy(int fd, const std::string& answer, Patience& patience, Clock::time_point asked) {
  const std::string bytes = measured(answer);
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = send(fd, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) break;  // it has ended meanwhile
    sent += static_cast<std::size_t>(count);
  }
  patience.deadline += Clock::now() - asked;
}

void end_copy(pid_t copy) {
  kill(copy, SIGKILL);
  int status = 0;
  while (waitpid(copy, &status, 0) < 0 && errno == EINTR) {
  }
}

std::string how_it_died(int status, const std::string& thrown) {
  if (!thrown.empty()) return thrown + ", which nothing can catch there";
  if (WIFSIGNALED(status))
    return std::string("ended the process with the signal ") + signal_name(WTERMSIG(status)) + " (" +
           strsignal(WTERMSIG(status)) + ")";
  return "ended the process with exit(" + std::to_string(WEXITSTATUS(status)) + ")";
}

TrialResult conclude(pid_t copy, int fd, Duration limit, const std::function<bool()>& give_up,
                     const TrialAnswerer& answer) {
  Patience patience{Clock::now() + limit, give_up};
  Heard heard([&](const std::string& question) {
    const Clock::time_point asked = Clock::now();
    answer_copy(fd, answer ? answer(question) : std::string(), patience, asked);
  });
  const bool heard_out = hear_out(fd, patience, heard);
  close(fd);
  int status = 0;
  if (heard.over || !heard_out || !has_ended(copy, patience.deadline, status)) {
    end_copy(copy);  // its child processes may live on
    if (heard.over) return std::move(heard.result);
    // A copy that has closed the line and runs on says nothing.
    heard.result.ending = heard_out || patience.given_up() ? Ending::silent : Ending::too_long;
    heard.result.text = "did not return within " +
                        std::to_string(std::chrono::duration_cast<std::chrono::seconds>(limit).count()) +
                        " s";
    return std::move(heard.result);
  }
  // The forbidden call was made where all signals are blocked, as posix_spawn() does.
  const bool blocked = WIFSIGNALED(status) && WTERMSIG(status) == SIGSYS;
  heard.result.ending = blocked ? Ending::effect : Ending::died;
  heard.result.text = blocked ? kEffectText : how_it_died(status, heard.thrown);
  return std::move(heard.result);
}

// Returns whether there is memory for more than what a plugin needs at its start.
bool has_memory() {
  constexpr std::size_t kMuch = std::size_t{32} << 20;
  return std::unique_ptr<char[]>(new (std::nothrow) char[kMuch]) != nullptr;
}

TrialResult cannot_try(int reason) {
  throw_if_exhausted(reason);
  TrialResult result;
  result.text = std::string("cannot try it out: ") + std::strerror(reason);
  return result;
}

}  // namespace

TrialResult run_trial(const std::function<void(TrialLine&)>& attempt, Duration limit, Effects effects,
                      const std::function<bool()>& give_up, const TrialAnswerer& answer) {
  int fds[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, fds) != 0) return cannot_try(errno);
  ActivityKeeper here;
  here.keep();
  ActivityKeeper().restore();  // this fork() must not count as a plugin's
  const pid_t parent = getpid();
  const pid_t copy = fork();
  const int reason = errno;
  if (copy == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // however the parent ends, the copy does not outlive it
    if (getppid() != parent) _exit(1);
    close(fds[0]);
    run_copy(fds[1], attempt, effects);
  }
  here.restore();
  close(fds[1]);
  if (copy > 0) return conclude(copy, fds[0], limit, give_up, answer);
  close(fds[0]);
  return cannot_try(reason);
}

Status survives_trial(const std::function<void(const Step&)>& attempt, Duration limit) {
  const TrialResult tried =
      run_trial([&](TrialLine& line) { attempt([&line](const std::string& what) { line.step(what); }); },
                limit, Effects::any);
  switch (tried.ending) {
    case Ending::well: return ok();
    case Ending::silent:
      if (tried.text == kNoMemoryText && has_memory())
        return fail(Code::internal, tried.last_step + " threw std::bad_alloc, which nothing can catch there");
      if (tried.last_step.empty() || tried.text == kNoMemoryText) return fail(Code::unavailable, tried.text);
      [[fallthrough]];
    case Ending::too_long: return fail(Code::deadline_exceeded, tried.last_step + " " + tried.text);
    default: return fail(Code::internal, tried.last_step + " " + tried.text);
  }
}

}  // namespace orca::plugin
