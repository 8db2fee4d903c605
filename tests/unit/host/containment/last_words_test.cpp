// SPDX-License-Identifier: GPL-3.0-or-later
// What the other threads do while a signal ends the process.
#include "orca/host/last_words.hpp"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <new>
#include <string>
#include <thread>

#include "containment/environment.hpp"
#include "orca/host/stop_signal.hpp"

// The sanitizers have handlers of their own for these signals.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

using namespace orca;
using namespace orca::host;

namespace {

int* volatile g_nowhere = nullptr;

// A number that a copy of the process shares with it.
class SharedCount {
 public:
  SharedCount()
      : memory_(mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
                     -1, 0)),
        count_(new (memory_) std::atomic<int>(0)) {}
  ~SharedCount() { munmap(memory_, sizeof(std::atomic<int>)); }
  SharedCount(const SharedCount&) = delete;
  SharedCount& operator=(const SharedCount&) = delete;
  std::atomic<int>& operator*() const { return *count_; }

 private:
  void* memory_;
  std::atomic<int>* count_;
};

void begin_anew() {
  for (const int signal : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGTERM}) ::signal(signal, SIG_DFL);
  const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(null, STDERR_FILENO);
}

// Calls a hook again and again, with all checks around it.
[[noreturn]] void work_on(std::atomic<int>& turns) {
  for (;;) {
    const Activity activity("good", Hook::configure, nullptr);
    Environment::of_process().entering(activity);
    Environment::of_process().left(activity);
    ++turns;
  }
}

// Crashes while stopping the motors takes a while and another component works on.
[[noreturn]] void crash_beside_others(std::atomic<int>& alarms, std::atomic<int>& turns) {
  begin_anew();
  const LastWords words(EXIT_FAILURE, 3);
  StopSignal stop(EXIT_SUCCESS);
  stop.on_crash([&turns] {
    const int before = turns;
    while (turns < before + 10) std::this_thread::yield();
  });
  const KeptEnvironment kept(true, [&alarms](const idl::Alarm&) { ++alarms; });
  std::thread([&turns] { work_on(turns); }).detach();
  while (turns == 0) std::this_thread::yield();
  const Activity activity("bad", Hook::work, nullptr);
  Environment::of_process().entering(activity);
  *g_nowhere = 1;
  _exit(0);
}

// What a process says that ends in a deed of a component, as its last line on stderr.
std::string said_of(const std::function<void()>& deed) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t copy = fork();
  if (copy == 0) {
    begin_anew();
    dup2(ends[1], STDERR_FILENO);
    const LastWords words(EXIT_FAILURE, 3);
    const Activity activity("bad", Hook::work, nullptr);
    deed();
    _exit(0);
  }
  close(ends[1]);
  std::string said;
  std::array<char, 512> portion;
  for (ssize_t count; (count = read(ends[0], portion.data(), portion.size())) > 0;)
    said.append(portion.data(), static_cast<std::size_t>(count));
  close(ends[0]);
  int status = 0;
  REQUIRE(waitpid(copy, &status, 0) == copy);
  CHECK(WIFSIGNALED(status));
  return said;
}

// Reads a page of a file that has become shorter.
void read_behind_the_end() {
  const int file = memfd_create("short", MFD_CLOEXEC);
  if (ftruncate(file, 4096) != 0) _exit(0);
  const auto* const page = static_cast<volatile char*>(mmap(nullptr, 4096, PROT_READ, MAP_SHARED, file, 0));
  if (ftruncate(file, 0) != 0) _exit(0);
  static_cast<void>(*page);
}

}  // namespace

TEST_CASE("a process that dies of a signal says which one it was, and why if the signal shows that",
          "[host][last_words]") {
  const std::string begin = "error: bad: work() ended the process with the signal ";
  CHECK(said_of([] { *g_nowhere = 1; }) == begin + "SIGSEGV (it used memory that is not there, at 0x0)\n");
  CHECK_THAT(said_of(read_behind_the_end),
             Catch::StartsWith(begin + "SIGBUS (it used memory that is not there, at 0x"));
  CHECK(said_of([] { std::abort(); }) == begin + "SIGABRT (it called abort(), or the C++ library did)\n");
  CHECK(said_of([] { raise(SIGBUS); }) == begin + "SIGBUS (somebody sent it)\n");
#if defined(__x86_64__)
  CHECK(said_of([] { asm volatile("ud2"); }) == begin + "SIGILL\n");
#endif
}

TEST_CASE("a process that dies of a signal raises no alarm about the handler of that signal",
          "[host][last_words]") {
  const SharedCount alarms;
  const SharedCount turns;
  const pid_t copy = fork();
  if (copy == 0) crash_beside_others(*alarms, *turns);
  int status = 0;
  REQUIRE(waitpid(copy, &status, 0) == copy);
  CHECK(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGSEGV);
  CHECK(*turns >= 10);
  CHECK(*alarms == 0);
}
#endif
