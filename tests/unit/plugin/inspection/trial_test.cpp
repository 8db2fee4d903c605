// SPDX-License-Identifier: GPL-3.0-or-later
// Code that is tried out in a copy of the process cannot harm this process.
#include "inspection/trial.hpp"

#include <signal.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>

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

void no_way_out() { throw std::runtime_error("no way out"); }

}  // namespace

TEST_CASE("a function that returns or throws survives its trial", "[plugin][trial]") {
  CHECK(survives_trial([](const Step&) {}, 2s).ok());
  CHECK(survives_trial([](const Step&) { throw std::runtime_error("no harm"); }, 2s).ok());
}

TEST_CASE("the end of the copied process is reported with the step that it was at", "[plugin][trial]") {
  CHECK_THAT(death([] { std::abort(); }), Contains("the deed ended the process with the signal ABRT"));
  CHECK_THAT(death([] { raise(SIGKILL); }), Contains("the deed") && Contains("KILL"));
  CHECK_THAT(death([] { _exit(3); }), Contains("the deed ended the process with exit(3)"));
  CHECK_THAT(death([]() noexcept { no_way_out(); }),
             Contains("the deed threw std::runtime_error: no way out, which nothing can catch there"));
  CHECK_THAT(death([] { std::terminate(); }), Contains("the deed ended the process with exit(1)"));
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
