// SPDX-License-Identifier: GPL-3.0-or-later
// Words in shared memory by which one process wakes a strand of another.
#include "orca/base/doorbell.hpp"

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <thread>

#include "executive_kinds.hpp"
#include "orca/base/strand.hpp"

using namespace orca;
using namespace orca::test;

namespace {

// Memory that this process shares with those that it forks.
template <class T>
class Shared {
 public:
  Shared()
      : place_(mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)),
        value_(*new (place_) T{}) {}
  ~Shared() { munmap(place_, sizeof(T)); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  T& operator*() { return value_; }
  T* operator->() { return &value_; }

 private:
  void* place_;
  T& value_;
};

struct Game {
  DoorbellWord bell{0};
  DoorbellWord bell_back{0};
  std::atomic<int> served{0};
};

// Runs `body` with a strand that `bell` wakes, on every executive of the steady clock.
void with_bell(DoorbellWord& bell, const std::function<void(Executive&, Strand&)>& body) {
  for (ExecutiveOptions options : all_kinds()) {
    if (options.clock == ClockKind::virtual_time) continue;
    if (options.backend != Backend::thread) options.doorbell = &bell;
    const auto executive = make(options);
    executive->run([&] {
      Strand strand(*executive, {"strand", 0});
      strand.set_doorbell(bell);
      CHECK(strand.doorbell() == &bell);
      strand.pause_until(executive->now());  // whatever the word was before
      body(*executive, strand);
    });
  }
}

// Returns what stands in the word of a strand that sleeps: what an owner leaves that is killed then.
std::uint32_t word_of_sleeper() {
  DoorbellWord bell{0};
  std::uint32_t seen = 0;
  const auto executive = make({});
  executive->run([&] {
    Strand strand(*executive, {"strand", 0});
    strand.set_doorbell(bell);
    strand.pause_until(executive->now());
    std::thread reader([&] {
      std::this_thread::sleep_for(30ms);
      seen = bell;
    });
    strand.pause_until(executive->now() + 60ms);
    reader.join();
  });
  return seen;
}

}  // namespace

TEST_CASE("a ring is remembered until the next wait, and several rings count as one", "[base][doorbell]") {
  DoorbellWord bell{0};
  with_bell(bell, [&](Executive& executive, Strand& strand) {
    ring(bell);
    ring(bell);
    const TimePoint start = executive.now();
    strand.pause_until(start + 10s);
    CHECK(executive.now() < start + 5s);
    strand.pause_until(executive.now() + 20ms);
    CHECK(executive.now() >= start + 20ms);
  });
}

TEST_CASE("a ring wakes a strand that sleeps", "[base][doorbell]") {
  DoorbellWord bell{0};
  with_bell(bell, [&](Executive& executive, Strand& strand) {
    const TimePoint start = executive.now();
    std::thread ringer([&] {
      std::this_thread::sleep_for(20ms);
      ring(bell);
    });
    strand.pause_until(start + 10s);
    CHECK(executive.now() < start + 5s);
    ringer.join();
  });
}

TEST_CASE("a strand with a doorbell is still woken by its own process", "[base][doorbell]") {
  DoorbellWord bell{0};
  with_bell(bell, [&](Executive& executive, Strand& strand) {
    const TimePoint start = executive.now();
    std::thread waker([&] {
      std::this_thread::sleep_for(20ms);
      strand.wake();
    });
    strand.pause_until(start + 10s);
    CHECK(executive.now() < start + 5s);
    waker.join();
  });
}

TEST_CASE("whatever stands in the word when a strand takes it over counts as a ring", "[base][doorbell]") {
  const std::uint32_t left = GENERATE(0U, 1U, 2U, 3U, 0xffffffffU, word_of_sleeper());
  Shared<Game> game;
  const auto executive = make({});
  executive->run([&] {
    Strand strand(*executive, {"strand", 0});
    game->bell = left;
    strand.set_doorbell(game->bell);
    const TimePoint start = executive->now();
    strand.pause_until(start + 10s);
    CHECK(executive->now() < start + 5s);
    strand.pause_until(executive->now() + 5ms);
    CHECK(executive->now() >= start + 5ms);
  });
}

TEST_CASE("a stray write into the word of a sleeper does not delay the next ring", "[base][doorbell]") {
  const std::uint32_t stray = GENERATE(0U, 1U, 2U, 3U, 0x80000000U, 0xffffffffU);
  CAPTURE(stray);
  DoorbellWord bell{0};
  with_bell(bell, [&](Executive& executive, Strand& strand) {
    int in_time = 0;
    for (int i = 0; i < 3; ++i) {
      std::atomic<bool> rung{false};
      std::thread writer([&] {
        std::this_thread::sleep_for(20ms);
        bell.store(stray);
        std::this_thread::sleep_for(20ms);
        rung = true;
        ring(bell);
        bell.store(stray);
      });
      const TimePoint start = executive.now();
      CHECK(strand.wait_for(start + 10s, [&] { return rung.load(); }));
      if (executive.now() < start + 400ms) ++in_time;  // sooner than a sleeper looks by itself
      writer.join();
    }
    CHECK(in_time > 0);  // a busy machine may delay some
  });
}

TEST_CASE("a sleeper whose word says by mistake that it was rung looks by itself after half a second",
          "[base][doorbell]") {
  DoorbellWord bell{0};
  with_bell(bell, [&](Executive& executive, Strand& strand) {
    ring(bell);
    const std::uint32_t looks_rung = bell;
    strand.pause_until(executive.now());
    std::atomic<bool> rung{false};
    std::thread writer([&] {
      std::this_thread::sleep_for(20ms);
      bell.store(looks_rung);
      rung = true;
      ring(bell);
    });
    const TimePoint start = executive.now();
    CHECK(strand.wait_for(start + 10s, [&] { return rung.load(); }));
    CHECK(executive.now() < start + 5s);
    writer.join();
  });
}

TEST_CASE("no ring between two processes is lost", "[base][doorbell]") {
  constexpr int kRounds = 20'000;
  Shared<Game> game;
  const pid_t child = fork();
  if (child == 0) {  // serves each ball back
    const auto executive = make({});
    executive->run([&] {
      Strand strand(*executive, {"child", 0});
      strand.set_doorbell(game->bell);
      for (int round = 1; round <= kRounds; ++round) {
        if (!strand.wait_for(executive->now() + 5s, [&] { return game->served >= 2 * round - 1; })) _exit(1);
        game->served = 2 * round;
        ring(game->bell_back);
      }
    });
    _exit(0);
  }
  const auto executive = make({});
  int round = 0;
  executive->run([&] {
    Strand strand(*executive, {"parent", 0});
    strand.set_doorbell(game->bell_back);
    for (bool goes_on = true; goes_on && round < kRounds;) {
      game->served = 2 * ++round - 1;
      ring(game->bell);
      goes_on = strand.wait_for(executive->now() + 5s, [&] { return game->served >= 2 * round; });
    }
  });
  int status = -1;
  waitpid(child, &status, 0);
  CHECK(round == kRounds);
  CHECK(status == 0);
}

TEST_CASE("virtual time has no doorbell", "[base][doorbell]") {
  DoorbellWord bell{0};
  const auto refused =
      make_executive({.clock = ClockKind::virtual_time, .backend = Backend::baton, .doorbell = &bell});
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().code == Code::invalid_argument);
}

namespace {

struct Counted final : Intake {
  bool take_in() override {
    ++looks;
    return std::exchange(arrived, false);
  }
  int looks = 0;
  bool arrived = false;
};

}  // namespace

TEST_CASE("a strand looks at its intakes before it sleeps, and does not sleep if something has arrived",
          "[base][strand]") {
  for (const ExecutiveOptions& options : all_kinds()) {
    const auto executive = make(options);
    executive->run([&] {
      Strand strand(*executive, {"strand", 0});
      Counted first;
      Counted second;
      strand.add_intake(first);
      strand.add_intake(second);
      first.arrived = true;
      const TimePoint start = executive->now();
      strand.pause_until(start + 1h);
      CHECK(executive->now() < start + 1min);
      CHECK(second.looks == 1);
      CHECK_FALSE(strand.take_in());
      CHECK(second.looks == 2);
      second.arrived = true;
      CHECK(strand.wait_for(start + 1h, [&] { return first.looks == 3; }));
      strand.remove_intake(first);
      CHECK_FALSE(strand.take_in());
      CHECK(first.looks == 3);
      strand.remove_intake(second);
    });
  }
}

namespace {

// Wakes the strand for what has arrived, as a queue does.
struct Waking final : Intake {
  explicit Waking(Strand& to_wake) : strand(to_wake) {}
  bool take_in() override {
    if (!std::exchange(arrived, false)) return false;
    strand.wake();
    return true;
  }
  Strand& strand;
  bool arrived = false;
};

}  // namespace

TEST_CASE("what a look takes in still ends the next wait, and what a wait takes in ends that wait alone",
          "[base][strand]") {
  DoorbellWord bell{0};
  with_bell(bell, [](Executive& executive, Strand& strand) {
    Waking intake(strand);
    strand.add_intake(intake);
    const TimePoint start = executive.now();
    intake.arrived = true;
    CHECK(strand.take_in());
    strand.pause_until(start + 10s);
    intake.arrived = true;
    strand.pause_until(start + 10s);
    const TimePoint woken = executive.now();
    CHECK(woken < start + 5s);
    strand.pause_until(woken + 20ms);
    CHECK(executive.now() >= woken + 20ms);
    strand.remove_intake(intake);
  });
}
