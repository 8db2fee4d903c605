// SPDX-License-Identifier: GPL-3.0-or-later
// A thread may run in a plugin if it sleeps there, if it will return there, or if nobody can tell.
#include "inspection/plugin_threads.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <fstream>
#include <semaphore>
#include <string>
#include <thread>

using namespace orca::plugin;

namespace {

// Words that are on no stack by chance.
constexpr std::uintptr_t kOthers = 0x5a5a'1111'2222'0000;
constexpr std::uintptr_t kOwn = 0x5a5a'3333'4444'0000;

bool may_run_at(std::uintptr_t address) { return threads_may_run_in(address, address + 1); }

// A thread with a word on its stack, that many bytes above the place where it sleeps.
template <std::size_t kDepth>
class Sleeper {
 public:
  explicit Sleeper(std::uintptr_t word) : thread_([this, word] { sleep_with(word); }) { ready_.acquire(); }
  ~Sleeper() { end(); }
  Sleeper(const Sleeper&) = delete;
  Sleeper& operator=(const Sleeper&) = delete;

  void end() {
    wake_.release();
    if (thread_.joinable()) thread_.join();
  }
  // Returns the address of the code at which it sleeps, as the system says.
  [[nodiscard]] std::uintptr_t code() const {
    std::string line;
    do {
      std::ifstream file("/proc/self/task/" + std::to_string(id_) + "/syscall");
      std::getline(file, line);
    } while (line == "running");
    return std::stoul(line.substr(line.rfind(' ')), nullptr, 16);
  }

 private:
  __attribute__((noinline)) void sleep_with(std::uintptr_t word) {
    [[maybe_unused]] volatile std::uintptr_t kept = word;
    sleep_below();
    kept = 0;
  }
  __attribute__((noinline)) void sleep_below() {
    std::array<volatile char, kDepth> room;
    room[0] = 0;
    id_ = gettid();
    ready_.release();
    wake_.acquire();
    room[0] = 1;
  }

  pid_t id_ = 0;
  std::binary_semaphore ready_{0}, wake_{0};
  std::thread thread_;
};

}  // namespace

TEST_CASE("a thread that will return into a plugin may run in it, and one that has ended may not",
          "[plugin][threads]") {
  Sleeper<16> sleeper(kOthers);
  CHECK(may_run_at(kOthers));
  CHECK_FALSE(may_run_at(kOthers - 1));
  CHECK_FALSE(may_run_at(kOthers + 1));
  sleeper.end();
  CHECK_FALSE(may_run_at(kOthers));
}

TEST_CASE("a thread that sleeps in a plugin may run in it", "[plugin][threads]") {
  const Sleeper<16> sleeper(kOthers);
  CHECK(may_run_at(sleeper.code()));
}

TEST_CASE("the caller of a plugin is found on a stack of half a megabyte", "[plugin][threads]") {
  const Sleeper<512 * 1024> sleeper(kOthers);
  CHECK(may_run_at(kOthers));
}

TEST_CASE("the thread that asks does not count", "[plugin][threads]") {
  [[maybe_unused]] volatile std::uintptr_t kept = kOwn;
  CHECK_FALSE(may_run_at(kOwn));
  kept = 0;
}

TEST_CASE("a thread that never sleeps may run anywhere", "[plugin][threads]") {
  std::atomic<bool> stop = false;
  std::thread busy([&] {
    while (!stop) {
    }
  });
  CHECK(may_run_at(kOthers));
  stop = true;
  busy.join();
  CHECK_FALSE(may_run_at(kOthers));
}
