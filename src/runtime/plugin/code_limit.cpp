// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/code_limit.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>

namespace orca::plugin {
namespace {

std::atomic<pid_t> g_program{0};  // whose main thread is limited
int g_signal = 0;
Duration g_limit{0};

constexpr Duration kOnceMore = 1s;

Duration now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return std::chrono::seconds(time.tv_sec) + Duration(time.tv_nsec);
}

// Returns how long this thread has waited for a processor so far; 0 where the system does not say it. Called in a signal handler.
Duration waited() {
  char text[64] = {};  // nanoseconds run, nanoseconds waited, ...
  const int file = open("/proc/thread-self/schedstat", O_RDONLY | O_CLOEXEC);
  if (file < 0) return Duration{0};
  const ssize_t size = read(file, text, sizeof text - 1);
  close(file);
  const char* at = std::find(text, text + std::max<ssize_t>(size, 0), ' ');
  std::int64_t time = 0;
  for (++at; at < text + size && *at >= '0' && *at <= '9'; ++at) time = 10 * time + (*at - '0');
  return Duration(time);
}

void set(timer_t timer, Duration time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time);
  const itimerspec once{{0, 0}, {seconds.count(), static_cast<long>((time - seconds).count())}};
  timer_settime(timer, 0, &once, nullptr);
}

}  // namespace

void CodeLimit::enforce(int signal, Duration limit) {
  g_signal = signal;
  g_limit = limit;
  g_program.store(getpid());
}

CodeLimit::CodeLimit() {
  const pid_t program = g_program.load();
  if (program == 0 || getpid() != program || gettid() != program) return;
  sigevent event{};
  event.sigev_notify = SIGEV_THREAD_ID;
  event.sigev_signo = g_signal;
  event.sigev_value.sival_ptr = this;
  event._sigev_un._tid = program;
  timer_t timer{};
  if (timer_create(CLOCK_MONOTONIC, &event, &timer) != 0) return;  // then there is no limit
  timer_ = timer;
  begun_ = now();
  waited_ = waited();
  set(timer, g_limit);
}

CodeLimit::~CodeLimit() {
  if (timer_) timer_delete(*timer_);
}

// A thread that had no processor, or was stopped, is not to blame: the time in which it waited does not count, and after one that the
// system does not count, as when the process was stopped, it gets a second to come to its end.
bool CodeLimit::is_over() {
  const Duration left = g_limit - (now() - begun_ - (waited() - waited_));
  if (left <= Duration{0} && asked_) return true;
  asked_ = left <= Duration{0};
  set(*timer_, asked_ ? kOnceMore : left);
  return false;
}

}  // namespace orca::plugin
