// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>

namespace orca {

using namespace std::chrono_literals;  // NOLINT: 50ms and 2s are part of the vocabulary of a component.

/// A span of time [ns].
using Duration = std::chrono::nanoseconds;

/// The clock that all of Orca's time stamps refer to. It has no now(): the executive gives the time, because
/// in a simulation it is virtual.
struct Clock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  static constexpr bool is_steady = true;
};

/// An instant. Steady clock: ns since the Unix epoch, anchored once at process start and never adjusted
/// afterwards. Virtual clock: ns since the start of the run.
using TimePoint = std::chrono::time_point<Clock, Duration>;

/// Later than any instant: wait without limit.
inline constexpr TimePoint kForever = TimePoint::max();

[[nodiscard]] constexpr double to_seconds(Duration d) { return std::chrono::duration<double>(d).count(); }
[[nodiscard]] constexpr double to_seconds(TimePoint t) { return to_seconds(t.time_since_epoch()); }

/// The longest time that from_seconds() returns, 146 years: an instant of today plus that is no overflow.
inline constexpr Duration kLongestTime = Duration::max() / 2;

/// @param seconds [s]  rounded to the nearest nanosecond.
/// @return at most kLongestTime, forwards or backwards; zero if it is no number.
[[nodiscard]] constexpr Duration from_seconds(double seconds) {
  const double ns = seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5);
  if (ns >= static_cast<double>(kLongestTime.count())) return kLongestTime;
  if (ns <= -static_cast<double>(kLongestTime.count())) return -kLongestTime;
  return ns == ns ? Duration{static_cast<std::int64_t>(ns)} : Duration{0};  // NaN is unlike itself
}

/// Returns t + d without overflow: kForever stays kForever.
[[nodiscard]] constexpr TimePoint saturating_add(TimePoint t, Duration d) {
  return d.count() > 0 && t > TimePoint::max() - d ? kForever : t + d;
}

}  // namespace orca
