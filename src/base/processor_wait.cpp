// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/system/processor_wait.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace orca {
namespace {

using std::filesystem::path;

// The times that the system has given to threads so far; all 0 where it does not report them.
struct Given {
  Duration ran{0};
  Duration waited{0};
  bool can_run = false;
};

// Not below the folder of its process: there each of its entries costs who waits for the end of the process a millisecond.
path facts_of(pid_t thread) { return path("/proc") / std::to_string(thread); }

bool can_run(pid_t thread) {
  std::ifstream file(facts_of(thread) / "stat");
  std::string line;
  std::getline(file, line);
  const std::size_t name_end = line.rfind(')');
  return name_end != std::string::npos && line.compare(name_end, 3, ") R") == 0;
}

void add(pid_t thread, Given& sum) {
  std::ifstream file(facts_of(thread) / "schedstat");
  std::int64_t ran = 0;     // [ns]
  std::int64_t waited = 0;  // [ns]
  if (!(file >> ran >> waited)) return;
  sum.ran += Duration(ran);
  sum.waited += Duration(waited);
  sum.can_run = sum.can_run || can_run(thread);
}

std::vector<pid_t> threads_of(pid_t process) {
  std::vector<pid_t> threads;
  std::error_code gone;  // the process may end meanwhile
  std::filesystem::directory_iterator each(facts_of(process) / "task", gone);
  for (; !gone && each != std::filesystem::directory_iterator(); each.increment(gone))
    threads.push_back(static_cast<pid_t>(std::stol(each->path().filename().string())));
  return threads;
}

Given given_to(pid_t process, std::optional<pid_t> thread) {
  Given sum;
  if (thread) return add(*thread, sum), sum;
  for (const pid_t each : threads_of(process)) add(each, sum);
  return sum;
}

}  // namespace

// A thread that can run and has not run since the last look waits. The sum is the wait that the system has not counted yet, which
// is seconds long where others are preferred. A thread that ends takes its time with it.
Duration ProcessorWait::look() {
  const Given given = given_to(process_, thread_);
  const Clock::time_point now = Clock::now();
  if (!given.can_run || given.ran != ran_) last_ran_ = now;
  ran_ = given.ran;
  waited_ = std::max(waited_, given.waited + std::chrono::duration_cast<Duration>(now - last_ran_));
  return waited_;
}

std::optional<pid_t> find_thread(pid_t process, const char* name) {
  for (const pid_t thread : threads_of(process)) {
    std::ifstream file(facts_of(thread) / "comm");
    std::string called;
    if (std::getline(file, called) && called == name) return thread;
  }
  return std::nullopt;
}

}  // namespace orca
