// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/code_limit.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>

namespace orca::plugin {
namespace {

std::atomic<pid_t> g_program{0};  // whose main thread is limited
int g_signal = 0;
Duration g_limit{0};

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
  event._sigev_un._tid = program;
  timer_t timer{};
  if (timer_create(CLOCK_MONOTONIC, &event, &timer) != 0) return;  // then there is no limit
  timer_ = timer;
  const std::time_t seconds = std::chrono::duration_cast<std::chrono::seconds>(g_limit).count();
  const itimerspec once{{0, 0}, {seconds, 0}};
  timer_settime(timer, 0, &once, nullptr);
}

CodeLimit::~CodeLimit() {
  if (timer_) timer_delete(*timer_);
}

}  // namespace orca::plugin
