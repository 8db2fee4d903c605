// SPDX-License-Identifier: GPL-3.0-or-later
// The pace of virtual time. Nothing here depends on how long the wall clock takes.
#include <catch2/catch.hpp>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "executive_kinds.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/base/system/pace.hpp"

using namespace orca;
using namespace orca::test;

namespace {

constexpr TimePoint at(Duration time) { return TimePoint(time); }

// Two tasks with the same period, and how they take turns until 100 ms have passed.
std::string turns(Executive& executive) {
  std::string order;
  executive.run([&] {
    std::vector<std::unique_ptr<Task>> tasks;
    for (const char name : {'a', 'b'}) {
      tasks.push_back(executive.spawn({std::string(1, name)}, [&, name] {
        for (int i = 1; i <= 10; ++i) {
          executive.sleep_until(at(i * 10ms));
          order += name;
        }
      }));
    }
  });
  return order + " " + std::to_string(executive.now().time_since_epoch().count());
}

std::unique_ptr<Executive> paced(const ExecutiveOptions& options, Pace& pace) {
  return make_paced_executive(options, pace).value();
}

// Waits until a run has come to the end of its step.
void await_pause(const Pace& pace) {
  while (pace.look().steps) std::this_thread::yield();
}

}  // namespace

TEST_CASE("only virtual time has a pace", "[base][pace]") {
  Pace pace(1.0);
  CHECK_FALSE(make_paced_executive({ClockKind::steady, Backend::fiber}, pace).has_value());
}

TEST_CASE("a pace that cannot be kept is refused", "[base][pace]") {
  Pace pace(1.0);
  for (const double factor : {-1.0, 0.001, 2000.0, std::numeric_limits<double>::quiet_NaN()})
    CHECK_FALSE(pace.set(factor).ok());
  CHECK(pace.look().factor == 1.0);
  CHECK_FALSE(pace.step(0s).ok());
  CHECK_FALSE(pace.look().steps);
}

TEST_CASE("tasks take the same turns at the same times at any pace", "[base][pace]") {
  for (const ExecutiveOptions& options : virtual_kinds()) {
    const std::string expected = turns(*make_executive(options).value());
    for (const double factor : {Pace::kFast, 1000.0, 2.0}) {
      Pace pace(factor);
      CHECK(turns(*paced(options, pace)) == expected);
    }
  }
}

TEST_CASE("virtual time does not pass before the clock has reached it", "[base][pace]") {
  Pace pace(2.0);
  const auto executive = paced(virtual_kinds().front(), pace);
  const TimePoint before = steady_now();
  (void)turns(*executive);
  CHECK(steady_now() - before >= 50ms);  // 100 ms at twice the pace
}

TEST_CASE("a paused run stands, and a step moves it by exactly its time", "[base][pace]") {
  Pace pace(0.0);
  const auto executive = paced(virtual_kinds().front(), pace);
  std::atomic<int> laps{0};
  std::thread operator_thread([&] {
    CHECK(pace.step(25ms).ok());
    await_pause(pace);
    CHECK(pace.look().time == at(25ms));
    CHECK(pace.look().factor == 0.0);
    CHECK(laps == 2);
    CHECK(pace.look().time == at(25ms));
    CHECK(pace.step(5ms).ok());
    await_pause(pace);
    CHECK(pace.look().time == at(30ms));
    CHECK(laps == 3);
    pace.finish();
  });
  executive->run([&] {
    for (int i = 1; i <= 5; ++i) {
      executive->sleep_until(at(i * 10ms));
      laps = i;
    }
  });
  operator_thread.join();
  CHECK(executive->now() == at(50ms));
}

TEST_CASE("whoever notifies an event of a paused run is heard, and no time passes", "[base][pace]") {
  Pace pace(0.0);
  const auto executive = paced(virtual_kinds().front(), pace);
  const auto event = executive->make_event();
  std::thread outside([&] { event->notify(); });
  executive->run([&] {
    CHECK(event->wait_until(at(10ms)));
    CHECK(executive->now() == at(0ms));
    pace.finish();
    executive->sleep_until(at(10ms));
  });
  outside.join();
  CHECK(pace.look().time == at(10ms));
}

TEST_CASE("a run that has to end does not stay paused", "[base][pace]") {
  Pace pace(0.0);
  const auto executive = paced(virtual_kinds().front(), pace);
  pace.finish();
  REQUIRE(pace.set(0.0).ok());
  executive->run([&] { executive->sleep_until(at(10ms)); });
  CHECK(executive->now() == at(10ms));
}

TEST_CASE("a pace keeps the time at which its run began to end, whatever passes later", "[base][pace]") {
  Pace pace(0.0);
  const auto executive = paced(virtual_kinds().front(), pace);
  CHECK_FALSE(pace.look().finished);
  REQUIRE(pace.step(10ms).ok());
  executive->run([&] {
    executive->sleep_until(at(5ms));
    pace.finish();
    executive->sleep_until(at(20ms));
    pace.finish();
  });
  CHECK(pace.look().finished == at(5ms));
  CHECK(pace.look().time == at(20ms));
}
