// SPDX-License-Identifier: GPL-3.0-or-later
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cfenv>
#include <clocale>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "orca/component.hpp"

namespace {

int* volatile g_nowhere = nullptr;
volatile int g_zero = 0;
volatile int g_hundred = 100;

int overflow(int depth) {
  volatile char room[1000] = {};
  room[0] = static_cast<char>(depth);
  return depth == -1 ? room[0] : overflow(depth + 1) + room[0];
}

void throw_where_nothing_may() noexcept {
  const auto thrower = [] { throw std::runtime_error("the brakes are gone"); };
  thrower();
}

struct Mute : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return nullptr; }
};

void end_quietly_from_now_on() {
  std::set_terminate([] { _exit(0); });
}

void steal_output() {
  const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(null, STDOUT_FILENO);
  close(null);
}

// Opening a file for writing ends the trial of configure(), so this happens at the start.
void hang_after_trial() {
  close(open("/dev/null", O_WRONLY | O_CLOEXEC));
  for (;;) sleep(1);
}

int use_stack(std::size_t bytes) {
  volatile char* const room = static_cast<char*>(__builtin_alloca(bytes));
  for (std::size_t i = 0; i < bytes; i += 4096) room[i] = 1;
  return room[0];
}

void lower_limit() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = 64;
  setrlimit(RLIMIT_NOFILE, &limit);
}

void lower_hard_limit() {
  const rlimit limit{1000, 1000};  // CPU time [s]
  setrlimit(RLIMIT_CPU, &limit);
}

void block_signal() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGUSR1);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

void open_many(int count) {
  for (int i = 0; i < count; ++i)
    if (open("/dev/null", O_RDONLY) < 0) return;
}

void close_many() {
  for (int fd = 0; fd < 100; ++fd) close(fd);
}

void leave_thread() {
  std::thread([] {
    for (;;) sleep(1);
  }).detach();
}

void take_memory() {
  static std::vector<std::unique_ptr<char[]>> taken;  // until the plugin is unloaded
  taken.push_back(std::make_unique<char[]>(1 << 20));
}

// Writes another byte each time into all memory that the processes of the system share and that this process may write.
void scribble() {
  static std::vector<std::span<char>> places;
  static char byte = 0;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; places.empty() && std::getline(maps, line);) {
    std::uintptr_t begin = 0, end = 0;
    char rights[8] = {};
    if (line.find("/memfd:orca-run") == std::string::npos) continue;
    if (std::sscanf(line.c_str(), "%lx-%lx %7s", &begin, &end, rights) == 3 && rights[1] == 'w')
      places.emplace_back(reinterpret_cast<char*>(begin), end - begin);
  }
  --byte;
  for (const std::span<char> place : places) std::ranges::fill(place, byte);
}

using Deeds = std::map<std::string, std::function<void()>>;

const Deeds& deeds() {
  static const Deeds all{
      {"abort", [] { std::abort(); }},
      {"close", close_many},
      {"divide", [] { g_zero = g_hundred / g_zero; }},
      {"exit", [] { std::exit(0); }},
      {"folder", [] { (void)!chdir("/"); }},
      {"fork", [] { (void)!fork(); }},
      {"hard_limit", lower_hard_limit},
      {"hang", hang_after_trial},
      {"handler", [] { signal(SIGTERM, SIG_IGN); }},
      {"leak", [] { open_many(1); }},
      {"leak_all", [] { open_many(1000000); }},
      {"hoard",
       [] {
         for (;;) take_memory();
       }},
      {"limit", lower_limit},
      {"locale", [] { std::setlocale(LC_ALL, "C.UTF-8"); }},
      {"mask", block_signal},
      {"noexcept", throw_where_nothing_may},
      {"memory", take_memory},
      {"mute", [] { throw Mute(); }},
      {"none", [] {}},
      {"overflow", [] { g_zero = overflow(0); }},
      {"quick_exit", [] { std::quick_exit(0); }},
      {"rounding", [] { std::fesetround(FE_UPWARD); }},
      {"redirect", steal_output},
      {"scribble", scribble},
      {"segfault", [] { *g_nowhere = 1; }},
      {"sleep", [] { ::sleep(10); }},
      {"stack", [] { g_zero = use_stack(1'200'000); }},
      {"terminate", end_quietly_from_now_on},
      {"thread", leave_thread},
      {"umask", [] { umask(0); }},
  };
  return all;
}

/// Does `deed` in the hook that `where` names and `then` in each lap, and works quietly otherwise.
class Hooligan final : public orca::Component {
 public:
  explicit Hooligan(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(50)); }

 private:
  orca::Status configure() override { return act("configure"), orca::ok(); }
  orca::Status start() override { return act("start"), orca::ok(); }
  void stop() override { act("stop"); }
  orca::Outcome work() override {
    act("work");
    if (!then_->empty()) deeds().at (*then_)();
    if (*where_ == "after_wait") {
      Component::sleep(std::chrono::milliseconds(5));
      act("after_wait");
    }
    if (*where_ == "later") {
      Component::sleep(std::chrono::duration_cast<orca::Duration>(std::chrono::duration<double>(*later_)));
      act("later");
    }
    return orca::again();
  }

  void act(const std::string& here) const {
    if (here == *where_) deeds().at (*deed_)();
  }

  orca::Param<std::string> where_{*this, "where", "work"};
  orca::Param<std::string> deed_{*this, "deed", "none"};
  orca::Param<double> later_{*this, "later", 1.0, {.unit = "s", .text = "How much later where=later is."}};
  orca::Param<std::string> then_{*this, "then", "", {.text = "A second deed, in each lap; empty: none."}};
};

}  // namespace

ORCA_COMPONENT(Hooligan, "test.Hooligan")
ORCA_ALLOW_IN_VIRTUAL_TIME("fork", "it is what is tested")
ORCA_ALLOW_IN_VIRTUAL_TIME("/proc/", "it looks for what it damages")
ORCA_ALLOW_IN_VIRTUAL_TIME("sleep", "it is what is tested")
ORCA_ALLOW_IN_VIRTUAL_TIME("std::thread::_M_start_thread", "it is what is tested")
