// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/team.hpp"

#include <catch2/catch.hpp>

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>

#include "orca/base/activity.hpp"

using namespace orca;

namespace {

// Returns how often work(i) was called, for each i.
std::vector<int> calls_of(Team& team, std::size_t count) {
  std::vector<int> calls(count);
  team.for_all(count, [&](std::size_t i) { ++calls[i]; });
  return calls;
}

// Returns whether two parts run at the same time: each waits, for long enough, until the other has begun.
bool meet_at_work(Team& team) {
  std::atomic<int> begun{0};
  std::atomic<int> met{0};
  team.for_all(2, [&](std::size_t) {
    ++begun;
    for (int tries = 0; tries < 10'000 && begun < 2; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds{1});
    if (begun == 2) ++met;
  });
  return met == 2;
}

// Limits the memory that this process can take beyond what it has, while this object lives.
class MemoryLimit {
 public:
  explicit MemoryLimit(rlim_t bytes) {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    REQUIRE(getrlimit(RLIMIT_AS, &before_) == 0);
    const rlimit limit{pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + bytes, before_.rlim_max};
    REQUIRE(setrlimit(RLIMIT_AS, &limit) == 0);
  }
  ~MemoryLimit() { setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

TEST_CASE("a team does each part of a loop once, however many it are and however many parts there are",
          "[base][team]") {
  Team team(GENERATE(1U, 2U, 5U, 0U));
  for (const std::size_t count : {0U, 1U, 2U, 3U, 100U})
    for (int again = 0; again < 200; ++again) REQUIRE(calls_of(team, count) == std::vector<int>(count, 1));
}

TEST_CASE("a team of two works on two parts at once", "[base][team]") {
  Team team(2);
  REQUIRE(team.threads() == 2);
  CHECK(meet_at_work(team));
}

TEST_CASE("a loop ends only when a helper that is slower than the caller has done its part", "[base][team]") {
  Team team(2);
  const std::thread::id caller = std::this_thread::get_id();
  for (int again = 0; again < 20; ++again) {
    std::atomic<int> begun{0};
    std::atomic<int> done{0};
    team.for_all(2, [&](std::size_t) {
      ++begun;
      while (begun < 2) std::this_thread::yield();  // one part for each of the two
      if (std::this_thread::get_id() != caller) std::this_thread::sleep_for(std::chrono::milliseconds{5});
      ++done;
    });
    CHECK(done == 2);
  }
}

TEST_CASE("a team of one starts no thread", "[base][team]") {
  Team team(1);
  CHECK(team.threads() == 1);
  const std::thread::id caller = std::this_thread::get_id();
  team.for_all(10, [&](std::size_t) { CHECK(std::this_thread::get_id() == caller); });
}

TEST_CASE("a team without a number has as many threads as the processor", "[base][team]") {
  CHECK(Team(0).threads() == std::max(1U, std::thread::hardware_concurrency()));
}

TEST_CASE("the exception of the first part that throws is rethrown, after all other parts are done",
          "[base][team]") {
  Team team(GENERATE(1U, 3U));
  for (int again = 0; again < 100; ++again) {
    std::vector<int> calls(50);
    const auto work = [&](std::size_t i) {
      ++calls[i];
      if (i % 20 == 7) throw std::runtime_error("part " + std::to_string(i));
    };
    REQUIRE_THROWS_WITH(team.for_all(50, work), "part 7");
    REQUIRE(calls == std::vector<int>(50, 1));
  }
  CHECK(calls_of(team, 50) == std::vector<int>(50, 1));
}

TEST_CASE("the work of a helper belongs to the activity of the caller", "[base][team]") {
  Team team(3);
  std::atomic<int> for_sim{0};
  {
    const Activity activity("sim", Hook::strand, nullptr);
    team.for_all(1000, [&](std::size_t) {
      if (Activity::current() != nullptr && Activity::current()->who() == std::string("sim")) ++for_sim;
    });
    CHECK(Activity::current() == &activity);
  }
  CHECK(for_sim == 1000);
  CHECK(Activity::current() == nullptr);
  team.for_all(1000, [&](std::size_t) {
    if (Activity::current() != nullptr) --for_sim;
  });
  CHECK(for_sim == 1000);
}

// A sanitizer needs more memory than this test leaves to the process.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("a team that gets fewer threads than requested still does all the work", "[base][team]") {
  std::unique_ptr<Team> team;
  {
    const MemoryLimit limit(40'000'000);  // About five stacks.
    team = std::make_unique<Team>(64);
  }
  CHECK(team->threads() >= 1);
  CHECK(team->threads() < 64);
  CHECK(calls_of(*team, 100) == std::vector<int>(100, 1));
}
#endif
