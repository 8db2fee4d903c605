// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/plugin/code_limit.hpp"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

using namespace orca;
using plugin::CodeLimit;

namespace {

volatile sig_atomic_t g_over = 0;

void note(int /*signal*/, siginfo_t* info, void* /*context*/) {
  if (static_cast<CodeLimit*>(info->si_value.sival_ptr)->is_over()) g_over = 1;
}

void rest(Duration time) {
  const auto end = std::chrono::steady_clock::now() + time;
  while (std::chrono::steady_clock::now() < end && g_over == 0) usleep(10'000);
}

// Stops the process that calls it for some time.
void stop_me_for(useconds_t time) {
  const pid_t me = getpid();
  const pid_t other = fork();
  if (other != 0) {
    usleep(50'000);
    waitpid(other, nullptr, 0);
    return;
  }
  kill(me, SIGSTOP);
  usleep(time);
  kill(me, SIGCONT);
  _exit(0);
}

// Runs in a copy of the process: the limit is the whole program's.
template <class Question>
bool holds_with_a_limit(Duration limit, const Question& question) {
  const pid_t copy = fork();
  if (copy == 0) {
    struct sigaction action {};
    action.sa_sigaction = note;
    action.sa_flags = SA_SIGINFO;
    sigaction(SIGRTMAX, &action, nullptr);
    CodeLimit::enforce(SIGRTMAX, limit);
    _exit(question() ? 0 : 1);
  }
  int status = 0;
  return waitpid(copy, &status, 0) == copy && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

TEST_CASE("code that does not return is over its limit, and what ends in time is not", "[plugin][limit]") {
  CHECK(holds_with_a_limit(200ms, [] {
    const CodeLimit limit;
    rest(60s);
    return g_over == 1;
  }));
  CHECK(holds_with_a_limit(30s, [] {
    const CodeLimit limit;
    rest(300ms);
    return g_over == 0;
  }));
}

TEST_CASE("the time in which the process was stopped is not held against the code", "[plugin][limit]") {
  CHECK(holds_with_a_limit(300ms, [] {
    const CodeLimit limit;
    stop_me_for(700'000);
    return g_over == 0;
  }));
}
