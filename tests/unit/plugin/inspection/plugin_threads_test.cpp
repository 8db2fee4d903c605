// SPDX-License-Identifier: GPL-3.0-or-later
// A thread may run in a plugin if it sleeps there, if it will return there, or if nobody can tell.
#include "inspection/plugin_threads.hpp"

#include <pthread.h>
#include <sys/mman.h>
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

// A thread that sleeps on a small stack, with 4 MiB of the same memory above it that nobody uses.
class SmallStack {
 public:
  SmallStack() {
    base_ =
        static_cast<char*>(mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    REQUIRE(base_ != MAP_FAILED);
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    REQUIRE(pthread_attr_setstack(&attributes, base_, kStack) == 0);
    REQUIRE(pthread_create(&thread_, &attributes, sleep, this) == 0);
    pthread_attr_destroy(&attributes);
    ready_.acquire();
  }
  ~SmallStack() {
    wake_.release();
    pthread_join(thread_, nullptr);
    munmap(base_, kSize);
  }
  SmallStack(const SmallStack&) = delete;
  SmallStack& operator=(const SmallStack&) = delete;

  // Returns its stack pointer while it sleeps.
  [[nodiscard]] char* top() const {
    std::string line;
    do {
      std::ifstream file("/proc/self/task/" + std::to_string(id_) + "/syscall");
      std::getline(file, line);
    } while (line == "running");
    const std::string but_last = line.substr(0, line.rfind(' '));
    return reinterpret_cast<char*>(std::stoul(but_last.substr(but_last.rfind(' ')), nullptr, 16));
  }
  void allow_all() { REQUIRE(mprotect(base_, kSize, PROT_READ | PROT_WRITE) == 0); }
  // Makes the last bytes other memory, which can only be read. Returns where they begin.
  char* end_before(std::size_t size) {
    REQUIRE(mprotect(base_ + kSize - size, size, PROT_READ) == 0);
    return base_ + kSize - size;
  }

 private:
  // The thread sanitizer takes most of a mebibyte for itself.
  static constexpr std::size_t kStack = 1024 * 1024, kSize = kStack + 4 * 1024 * 1024;

  static void* sleep(void* self) {
    auto& own = *static_cast<SmallStack*>(self);
    own.id_ = gettid();
    own.ready_.release();
    own.wake_.acquire();
    return nullptr;
  }

  char* base_ = nullptr;
  pthread_t thread_{};
  pid_t id_ = 0;
  std::binary_semaphore ready_{0}, wake_{0};
};

bool is_found_at(char* place) {
  *reinterpret_cast<std::uintptr_t*>(place) = kOthers;
  const bool found = may_run_at(kOthers);
  *reinterpret_cast<std::uintptr_t*>(place) = 0;
  return found;
}

}  // namespace

TEST_CASE("the first mebibyte of a stack is searched, to its last word", "[plugin][threads]") {
  SmallStack stack;
  char* const end = stack.top() + 1024 * 1024;
  CHECK(is_found_at(end - sizeof(std::uintptr_t)));
  CHECK_FALSE(is_found_at(end));
}

TEST_CASE("what lies in other memory behind a stack does not count", "[plugin][threads]") {
  SmallStack stack;
  constexpr std::size_t kMost = 4 * 1024 * 1024 - 64 * 1024;
  char* const edge = stack.end_before(kMost) - sizeof(std::uintptr_t);
  CHECK(is_found_at(edge));
  stack.allow_all();
  *reinterpret_cast<std::uintptr_t*>(edge + sizeof(std::uintptr_t)) = kOthers;
  CHECK(may_run_at(kOthers));
  (void)stack.end_before(kMost);
  CHECK_FALSE(may_run_at(kOthers));
}

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
