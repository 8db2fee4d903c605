// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/heartbeats.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::supervisor;

namespace {

using Hung = std::vector<std::size_t>;

// Heartbeats of two processes, and time as the test has it.
struct Bench {
  RunPage page = *RunPage::create(2, 0);
  Duration waited{0};  // for a processor, any process
  Heartbeats heartbeats{page, [this](std::size_t) { return waited; }};
  Moment now{100s};

  Bench() { (void)heartbeats.look(now); }
  void beat(std::size_t process) { page.heartbeat(process).fetch_add(1); }
  Hung look_after(Duration time) { return heartbeats.look(now += time); }

  // Looks whenever it is due until something hangs.
  std::pair<Hung, Duration> wait_for_hang(Duration limit) {
    const Moment begun = now;
    while (now - begun < limit && heartbeats.due()) {
      now = std::max(now, *heartbeats.due());
      if (auto hung = heartbeats.look(now); !hung.empty()) return {hung, now - begun};
    }
    return {{}, now - begun};
  }
};

}  // namespace

TEST_CASE("A process whose heart stands still is found within its limit and a tenth",
          "[supervisor][heartbeats]") {
  Bench bench;
  bench.heartbeats.watch(1, 500ms);
  bench.beat(1);
  CHECK(bench.look_after(10ms).empty());
  const auto [hung, after] = bench.wait_for_hang(10s);
  CHECK(hung == Hung{1});
  CHECK(after >= 500ms);
  CHECK(after <= 550ms);
}

TEST_CASE("Each process has its own limit", "[supervisor][heartbeats]") {
  Bench bench;
  bench.heartbeats.watch(0, 2s);
  bench.heartbeats.watch(1, 100ms);
  bench.beat(0);
  bench.beat(1);
  CHECK(bench.look_after(1ms).empty());
  CHECK(bench.wait_for_hang(10s).first == Hung{1});
  const auto [hung, after] = bench.wait_for_hang(10s);
  CHECK(hung == Hung{0});
  CHECK(after > 1800ms);
}

TEST_CASE("A process that beats in time never hangs", "[supervisor][heartbeats]") {
  Bench bench;
  bench.heartbeats.watch(0, 500ms);
  bench.page.heartbeat(0) = UINT32_MAX - 3;  // the count may begin anew
  for (int i = 0; i < 1000; ++i) {
    if (i % 9 == 0) bench.beat(0);
    CHECK(bench.look_after(50ms).empty());
  }
}

TEST_CASE("A process is judged from its first beat on", "[supervisor][heartbeats]") {
  Bench bench;
  bench.page.heartbeat(0) = 17;  // of the process that ran before
  bench.heartbeats.watch(0, 500ms);
  for (int i = 0; i < 100; ++i) CHECK(bench.look_after(50ms).empty());
  bench.beat(0);
  CHECK(bench.wait_for_hang(10s).first == Hung{0});
}

TEST_CASE("Time in which the supervisor itself was stopped does not count", "[supervisor][heartbeats]") {
  Bench bench;
  bench.heartbeats.watch(0, 500ms);
  bench.beat(0);
  CHECK(bench.look_after(1ms).empty());
  for (int stop = 0; stop < 5; ++stop) CHECK(bench.look_after(3600s).empty());
  bench.beat(0);
  CHECK(bench.look_after(50ms).empty());
  const auto [hung, after] = bench.wait_for_hang(10s);  // from here on it has stopped as well
  CHECK(hung == Hung{0});
  CHECK(after >= 500ms);
}

TEST_CASE("A hang is reported once, and one who ends is not watched", "[supervisor][heartbeats]") {
  Bench bench;
  bench.heartbeats.watch(0, 500ms);
  bench.heartbeats.watch(1, 500ms);
  bench.beat(0);
  bench.beat(1);
  CHECK(bench.look_after(1ms).empty());
  bench.heartbeats.forget(1);
  CHECK(bench.wait_for_hang(10s).first == Hung{0});
  CHECK_FALSE(bench.heartbeats.due());
  CHECK(bench.look_after(10s).empty());
}

TEST_CASE("A process that has worked before is judged although it does not beat any more",
          "[supervisor][heartbeats]") {
  Bench bench;
  bench.heartbeats.watch_working(1, 500ms);
  const auto [hung, after] = bench.wait_for_hang(10s);
  CHECK(hung == Hung{1});
  CHECK(after <= 600ms);
}

TEST_CASE("A process that has no processor does not hang, and it is told for how long it had none",
          "[supervisor][heartbeats]") {
  Bench bench;
  bench.heartbeats.watch(0, 500ms);
  bench.beat(0);
  CHECK(bench.look_after(10ms).empty());
  for (int i = 0; i < 100; ++i) {
    bench.waited += 50ms;
    CHECK(bench.look_after(50ms).empty());
  }
  CHECK(bench.heartbeats.take_starved().empty());  // it goes on
  bench.beat(0);
  CHECK(bench.look_after(50ms).empty());
  const auto starved = bench.heartbeats.take_starved();
  REQUIRE(starved.size() == 1);
  CHECK(starved[0].first == 0);
  CHECK(starved[0].second > 4500ms);
  CHECK(bench.heartbeats.take_starved().empty());
}

TEST_CASE("A process that hangs after it had no processor is found", "[supervisor][heartbeats]") {
  Bench bench;
  bench.heartbeats.watch(0, 500ms);
  bench.beat(0);
  CHECK(bench.look_after(10ms).empty());
  for (int i = 0; i < 20; ++i) {
    bench.waited += 50ms;
    CHECK(bench.look_after(50ms).empty());
  }
  const auto [hung, after] = bench.wait_for_hang(10s);
  CHECK(hung == Hung{0});
  CHECK(after <= 550ms);
}
