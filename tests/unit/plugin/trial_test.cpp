// SPDX-License-Identifier: GPL-3.0-or-later
// Code that is tried out in a copy of the process cannot harm this process.
#include "orca/plugin/trial.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/ipc.h>
#include <sys/mman.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "orca/base/log.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/object_type.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::plugin;
using Catch::Contains;

namespace {

using Step = std::function<void(const std::string&)>;

std::string death(const std::function<void()>& deed) {
  const Status status = survives_trial(
      [&](const Step& step) {
        step("the first step");
        step("the deed");
        deed();
      },
      2s);
  return status.ok() ? "" : status.error().text();
}

using Ending = TrialResult::Ending;

// Tries code that must leave no trace; it finds "before" and, if it gets there, "after".
TrialResult without_effects(const std::function<void()>& deed) {
  return run_trial(
      [&](TrialLine& line) {
        line.step("the deed");
        line.find("before");
        deed();
        line.find("after");
      },
      2s, Effects::none);
}

[[maybe_unused]] bool is_stopped(const std::function<void()>& deed) {
  const TrialResult tried = without_effects(deed);
  CHECK(tried.findings.front() == "before");
  return tried.ending == Ending::effect && tried.findings.size() == 1;
}

// A thread that does the same again and again while it lives.
class Busy {
 public:
  explicit Busy(const std::function<void()>& deed)
      : thread_([this, deed] {
          while (!ended_) deed();
        }) {}
  ~Busy() {
    ended_ = true;
    thread_.join();
  }

 private:
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

void no_way_out() { throw std::runtime_error("no way out"); }

}  // namespace

TEST_CASE("a function that returns or throws survives its trial", "[plugin][trial]") {
  CHECK(survives_trial([](const Step&) {}, 2s).ok());
  CHECK(survives_trial([](const Step&) { throw std::runtime_error("no harm"); }, 2s).ok());
}

TEST_CASE("the end of the copied process is reported with the step that it was at", "[plugin][trial]") {
  CHECK_THAT(death([] { std::abort(); }), Contains("the deed ended the process with the signal ABRT"));
  CHECK_THAT(death([] { raise(SIGKILL); }), Contains("the deed") && Contains("KILL"));
  CHECK_THAT(death([] { raise(SIGRTMIN + 3); }), Contains("with the signal RTMIN+3"));
  CHECK_THAT(death([] { _exit(3); }), Contains("the deed ended the process with exit(3)"));
  CHECK_THAT(death([]() noexcept { no_way_out(); }),
             Contains("the deed threw std::runtime_error: no way out, which nothing can catch there"));
  CHECK_THAT(death([] { std::terminate(); }), Contains("the deed ended the process with exit(1)"));
}

TEST_CASE("descriptors that a trial inherits lead nowhere: to no process, and into no file",
          "[plugin][trial]") {
  int line[2];
  REQUIRE(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, line) == 0);
  int pipe_ends[2];
  REQUIRE(pipe2(pipe_ends, O_CLOEXEC | O_NONBLOCK) == 0);
  const int file = open("/tmp", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  REQUIRE(file >= 0);
  const std::vector<int> all{line[0], line[1], pipe_ends[1], file};
  CHECK(survives_trial(
            [&](const Step&) {
              for (const int descriptor : all)
                if (write(descriptor, "junk", 4) != 4) std::abort();  // they are there
            },
            2s)
            .ok());
  char byte = 0;
  for (const int end : {line[0], line[1]}) CHECK(recv(end, &byte, 1, MSG_DONTWAIT) == -1);
  CHECK(read(pipe_ends[0], &byte, 1) == -1);
  CHECK(lseek(file, 0, SEEK_END) == 0);
  for (const int descriptor : {line[0], line[1], pipe_ends[0], pipe_ends[1], file}) close(descriptor);
}

TEST_CASE("a function that does not return is ended at its limit", "[plugin][trial]") {
  CHECK_THAT(death([] { pause(); }), Contains("the deed did not return within 2 s"));
}

TEST_CASE("only the last step is reported", "[plugin][trial]") {
  CHECK_THAT(death([] { _exit(3); }), !Contains("the first step"));
}

TEST_CASE("a trial may report more than fits in a pipe or a read", "[plugin][trial]") {
  const std::string long_step(300'000, 's');
  const auto attempt = [&](const Step& step) {
    for (const std::string& name : {long_step, std::string("a short step")}) step(name);
    _exit(3);
  };
  CHECK_THAT(survives_trial(attempt, 5s).error().text(),
             Contains("a short step ended the process with exit(3)"));
  CHECK(survives_trial([&](const Step& step) { step(long_step); }, 5s).ok());
}

TEST_CASE("a report is taken in whole, however the reads divide it", "[plugin][trial]") {
  for (std::size_t size = 505; size <= 515; ++size) {  // about as many bytes as one read brings
    CAPTURE(size);
    const std::string name(size, 's');
    CHECK(survives_trial([&](const Step& step) { step(name); }, 5s).ok());
    const auto attempt = [&](const Step& step) {
      step(name);
      usleep(1000);  // what comes next has a read of its own
      _exit(3);
    };
    CHECK_THAT(survives_trial(attempt, 5s).error().text(),
               Contains(name + " ended the process with exit(3)"));
  }
}

TEST_CASE("a function has survived its trial even if it leaves a process of its own behind",
          "[plugin][trial]") {
  const auto attempt = [](const Step&) {
    if (fork() == 0) {
      sleep(3);
      _exit(0);
    }
  };
  const auto start = std::chrono::steady_clock::now();
  CHECK(survives_trial(attempt, 2s).ok());
  CHECK(std::chrono::steady_clock::now() - start < 2s);
}

TEST_CASE("nothing is left of a trial: no process and no open file", "[plugin][trial]") {
  const auto open_files = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                         std::filesystem::directory_iterator());
  };
  const auto before = open_files();
  CHECK(survives_trial([](const Step&) {}, 2s).ok());
  (void)death([] { _exit(3); });
  CHECK(open_files() == before);
  CHECK(waitpid(-1, nullptr, WNOHANG) == -1);
  CHECK(errno == ECHILD);
}

TEST_CASE("signals to this process do not disturb a trial, neither during it nor before", "[plugin][trial]") {
  struct sigaction nothing {
  }, before{};
  nothing.sa_handler = [](int) {};  // without SA_RESTART: system calls are interrupted
  REQUIRE(sigaction(SIGALRM, &nothing, &before) == 0);
  const itimerval often{{0, 3000}, {0, 3000}}, never{};
  REQUIRE(setitimer(ITIMER_REAL, &often, nullptr) == 0);
  CHECK(survives_trial([](const Step&) { usleep(100'000); }, 2s).ok());
  CHECK_THAT(death([] {
               usleep(100'000);
               _exit(3);
             }),
             Contains("exit(3)"));
  REQUIRE(setitimer(ITIMER_REAL, &never, nullptr) == 0);
  REQUIRE(sigaction(SIGALRM, &before, nullptr) == 0);
  errno = EINTR;
  CHECK(survives_trial([](const Step&) {}, 2s).ok());
}

TEST_CASE("what is tried out cannot talk to the user", "[plugin][trial]") {
  const auto attempt = [](const Step&) {
    for (const int fd : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      if (std::filesystem::read_symlink("/proc/self/fd/" + std::to_string(fd)) != "/dev/null") _exit(10 + fd);
  };
  CHECK(survives_trial(attempt, 2s).ok());
}

TEST_CASE("a trial changes nothing in this process", "[plugin][trial]") {
  int value = 1;
  CHECK(survives_trial([&](const Step&) { value = 2; }, 2s).ok());
  CHECK(value == 1);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they use such calls themselves
TEST_CASE("what is found in a trial comes back whole, whatever bytes it has", "[plugin][trial]") {
  const std::string odd("a\n\0b", 4);
  const TrialResult tried = run_trial(
      [&](TrialLine& line) {
        line.find(odd);
        line.end();
      },
      2s, Effects::none);
  CHECK(tried.ending == Ending::well);
  CHECK(tried.findings == std::vector<std::string>{odd});
}

TEST_CASE("a trial without effects ends before files are written, made, renamed or removed",
          "[plugin][trial]") {
  const orca::test::TempFolder folder;
  const std::string there = folder.write("there", "whole");
  const std::string fresh = folder.file("fresh");
  CHECK(is_stopped([&] { std::ofstream(fresh) << "trace"; }));
  CHECK(is_stopped([&] { std::ofstream(there, std::ios::app) << "trace"; }));
  CHECK(is_stopped([&] { std::filesystem::remove(there); }));
  CHECK(is_stopped([&] { std::filesystem::rename(there, fresh); }));
  CHECK(is_stopped([&] { std::filesystem::create_directory(fresh); }));
  CHECK(is_stopped([&] { std::filesystem::create_symlink(there, fresh); }));
  CHECK(is_stopped([&] { std::filesystem::resize_file(there, 0); }));
  CHECK_FALSE(std::filesystem::exists(fresh));
  CHECK(orca::test::read_text(there) == "whole");
}

TEST_CASE("a trial without effects ends before shared memory, terminals, sockets and processes come to be",
          "[plugin][trial]") {
  const orca::test::TempFolder folder;
  CHECK(is_stopped([] { (void)shm_open("/orca_trial_test", O_CREAT | O_RDWR, 0600); }));
  CHECK(shm_open("/orca_trial_test", O_RDONLY, 0) == -1);
  CHECK(is_stopped([] { (void)shmget(IPC_PRIVATE, 4096, IPC_CREAT | 0600); }));
  CHECK(is_stopped([] { (void)posix_openpt(O_RDWR); }));
  CHECK(is_stopped([] {
    if (fork() == 0) _exit(0);
  }));
  CHECK(is_stopped([] { (void)std::system("true"); }));
  CHECK(is_stopped([] { kill(getppid(), SIGCONT); }));
  CHECK(is_stopped([&] {
    sockaddr_un address{AF_UNIX, {}};
    folder.file("socket").copy(address.sun_path, sizeof address.sun_path - 1);
    bind(socket(AF_UNIX, SOCK_STREAM, 0), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }));
  CHECK_FALSE(std::filesystem::exists(folder.file("socket")));
}

TEST_CASE("a trial without effects lets code read, write to its streams, and use threads",
          "[plugin][trial]") {
  const orca::test::TempFolder folder;
  const std::string file = folder.write("there", "whole");
  CHECK(without_effects([&] {
          if (orca::test::read_text(file) != "whole") _exit(3);
        }).ending == Ending::well);
  CHECK(without_effects([] { std::puts("hello"); }).ending == Ending::well);
  CHECK(without_effects([] {
          int ends[2];
          if (socketpair(AF_UNIX, SOCK_STREAM, 0, ends) != 0 || send(ends[0], "hello", 5, 0) != 5) _exit(3);
        }).ending == Ending::well);
  CHECK(without_effects([] { std::thread([] {}).join(); }).ending == Ending::well);
  CHECK(without_effects([] { std::abort(); }).text == "ended the process with the signal ABRT (Aborted)");
  CHECK(without_effects([] { pause(); }).ending == Ending::too_long);
}

TEST_CASE("a trial that is given up ends soon, and blames nobody", "[plugin][trial]") {
  const auto start = std::chrono::steady_clock::now();
  const TrialResult tried = run_trial([](TrialLine&) { pause(); }, 30s, Effects::none, [&] { return true; });
  CHECK(tried.ending == Ending::silent);
  CHECK(std::chrono::steady_clock::now() - start < 10s);
}

TEST_CASE("what is tried out may log and make objects whatever other threads did when it began",
          "[plugin][trial]") {
  const log::Listener slow([](const log::Line&) { std::this_thread::sleep_for(100us); });
  const ObjectType& type = *object_types().front();
  const auto speak = [] { log::debug("busy", "a line that is only heard"); };
  const auto make = [&type] { (void)make_object(type); };
  const Busy speaker(speak), maker(make);
  for (int i = 0; i < 50; ++i) {
    const TrialResult tried = without_effects([&] {
      speak();
      make();
    });
    INFO("trial " << i << ": " << tried.text);
    REQUIRE(tried.ending == Ending::well);
  }
}

TEST_CASE("code that closes all its descriptors does not escape its trial, nor hold it up",
          "[plugin][trial]") {
  const auto close_all = [] {
    for (int fd = 0; fd < 2000; ++fd) close(fd);
    pause();
  };
  CHECK(without_effects(close_all).ending == Ending::silent);
}
#endif
