// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/time.hpp"

#include <catch2/catch.hpp>
#include <limits>

using namespace orca;
using namespace std::chrono_literals;

TEST_CASE("seconds become the nearest nanosecond, on either side of zero", "[base][time]") {
  CHECK(from_seconds(0.0) == 0ns);
  CHECK(from_seconds(1.4e-9) == 1ns);
  CHECK(from_seconds(1.6e-9) == 2ns);
  CHECK(from_seconds(-1.4e-9) == -1ns);
  CHECK(from_seconds(-1.6e-9) == -2ns);
  CHECK(from_seconds(1.5) == 1500ms);
  CHECK(to_seconds(from_seconds(-2.25)) == -2.25);
}

TEST_CASE("seconds beyond all times become the longest time, which is no overflow today", "[base][time]") {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const TimePoint today{1'800'000'000s};
  for (const double seconds : {4.7e9, 1e10, 1e300, kInf}) {
    CHECK(from_seconds(seconds) == kLongestTime);
    CHECK(from_seconds(-seconds) == -kLongestTime);
    CHECK(today + from_seconds(seconds) > today);
    CHECK(today - from_seconds(seconds) < today);
  }
  CHECK(from_seconds(std::numeric_limits<double>::quiet_NaN()) == 0ns);
  CHECK(from_seconds(4.6e9) == 4'600'000'000s);
}

TEST_CASE("a time far ahead does not come back from behind when something is added", "[base][time]") {
  CHECK(saturating_add(TimePoint{1s}, 2s) == TimePoint{3s});
  CHECK(saturating_add(TimePoint{1s}, -2s) == TimePoint{-1s});
  CHECK(saturating_add(kForever, 1ns) == kForever);
  CHECK(saturating_add(kForever, 0ns) == kForever);
  CHECK(saturating_add(TimePoint{1s}, Duration::max()) == kForever);
  CHECK(saturating_add(TimePoint::max() - 5ns, 5ns) == TimePoint::max());
  CHECK(saturating_add(TimePoint::max() - 5ns, 6ns) == kForever);
}
