// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/system/recent_times.hpp"

#include <catch2/catch.hpp>
#include <initializer_list>

using namespace orca;
using namespace std::chrono_literals;

TEST_CASE("figures of recent durations are known to 6 %", "[recent_times]") {
  for (const Duration time : std::initializer_list<Duration>{2us, 17us, 480us, 9ms, 1300ms}) {
    RecentTimes times;
    for (int i = 0; i < 98; ++i) times.add(time, TimePoint(1s));
    for (int i = 0; i < 2; ++i) times.add(10 * time, TimePoint(1s));
    const TimeFigures figures = times.figures(TimePoint(1s));
    CHECK(figures.count == 100);
    CHECK(figures.p50 == Approx(to_seconds(time)).epsilon(0.0626));
    CHECK(figures.p99 == Approx(10 * to_seconds(time)).epsilon(0.0626));
  }
}

TEST_CASE("durations are forgotten after 5 to 10 s", "[recent_times]") {
  RecentTimes times;
  times.add(1ms, TimePoint(12s));
  CHECK(times.figures(TimePoint(17s)).count == 1);
  CHECK(times.figures(TimePoint(22s)).count == 0);
  times.add(2ms, TimePoint(23s));  // in the place of the one at 12 s
  CHECK(times.figures(TimePoint(23s)).count == 1);
  CHECK(times.figures(TimePoint(23s)).p50 == Approx(0.002).epsilon(0.0626));
}

TEST_CASE("durations that are too short or too long, or of none, give figures as well", "[recent_times]") {
  RecentTimes times;
  CHECK(times.figures(TimePoint(0s)).count == 0);
  times.add(-1s, TimePoint(0s));  // an object of a machine whose clock is ahead
  times.add(0s, TimePoint(0s));
  CHECK(times.figures(TimePoint(0s)).p99 < 2e-6);
  times.add(24h, TimePoint(0s));
  CHECK(times.figures(TimePoint(0s)).p99 > 1800.0);
  CHECK(times.figures(TimePoint(0s)).count == 3);
}
