// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/system/processor_wait.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace orca {
namespace {

using std::filesystem::path;

// The times that the system has given to threads so far; all 0 where it does not report them.
struct Given {
  Duration ran{0};
  Duration waited{0};
  bool can_run = false;
};

bool can_run(const path& thread) {
  std::ifstream file(thread / "stat");
  std::string line;
  std::getline(file, line);
  const std::size_t name_end = line.rfind(')');
  return name_end != std::string::npos && line.compare(name_end, 3, ") R") == 0;
}

void add(const path& thread, Given& sum) {
  std::ifstream file(thread / "schedstat");
  std::int64_t ran = 0;     // [ns]
  std::int64_t waited = 0;  // [ns]
  if (!(file >> ran >> waited)) return;
  sum.ran += Duration(ran);
  sum.waited += Duration(waited);
  sum.can_run = sum.can_run || can_run(thread);
}

path threads_of(pid_t process) { return path("/proc") / std::to_string(process) / "task"; }

Given given_to(pid_t process, std::optional<pid_t> thread) {
  Given sum;
  if (thread) return add(threads_of(process) / std::to_string(*thread), sum), sum;
  std::error_code unused;
  for (const auto& each : std::filesystem::directory_iterator(threads_of(process), unused))
    add(each.path(), sum);
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
  std::error_code unused;
  for (const auto& each : std::filesystem::directory_iterator(threads_of(process), unused)) {
    std::ifstream file(each.path() / "comm");
    std::string called;
    if (std::getline(file, called) && called == name)
      return static_cast<pid_t>(std::stol(each.path().filename().string()));
  }
  return std::nullopt;
}

}  // namespace orca
