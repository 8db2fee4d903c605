// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "orca/base/time.hpp"

namespace orca {

/// Figures of some durations. A plain value.
struct TimeFigures {
  std::uint64_t count = 0;
  double p50 = 0.0;  ///< [s] Half of them take no longer; known to 6 %.
  double p99 = 0.0;  ///< [s] 99 % of them take no longer; known to 6 %.
};

/// The durations of the last 5 to 10 s, counted in classes that are up to 12 % wide, from 1 us to half an hour. It never allocates.
///
/// Thread contract: add() from one thread at a time; figures() from any thread, which may miss what is just added.
class RecentTimes {
 public:
  /// @param now  of whatever clock; it never goes back.
  void add(Duration time, TimePoint now) {
    Window& window = windows_[static_cast<std::size_t>(number_at(now)) % windows_.size()];
    if (window.number.load(std::memory_order_relaxed) != number_at(now)) window.begin(number_at(now));
    std::atomic<std::uint32_t>& count = window.counts[class_of(time)];
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }

  [[nodiscard]] TimeFigures figures(TimePoint now) const {
    std::array<std::uint64_t, kClasses> counts{};
    TimeFigures figures;
    for (const Window& window : windows_) {
      const std::int64_t age = number_at(now) - window.number.load(std::memory_order_relaxed);
      if (age < 0 || age > 1) continue;
      for (std::size_t i = 0; i < kClasses; ++i) {
        const std::uint32_t count = window.counts[i].load(std::memory_order_relaxed);
        counts[i] += count;
        figures.count += count;
      }
    }
    figures.p50 = quantile(counts, figures.count / 2);
    figures.p99 = quantile(counts, figures.count * 99 / 100);
    return figures;
  }

 private:
  static constexpr Duration kSpan = 5s;  // of a window
  static constexpr int kPartBits = 3;    // each octave has 8 classes
  static constexpr int kFirstOctave = 10;
  static constexpr std::size_t kOctaves = 31;
  static constexpr std::size_t kClasses = kOctaves << kPartBits;

  struct Window {
    void begin(std::int64_t next) {
      for (std::atomic<std::uint32_t>& count : counts) count.store(0, std::memory_order_relaxed);
      number.store(next, std::memory_order_relaxed);
    }
    std::atomic<std::int64_t> number{-2};
    std::array<std::atomic<std::uint32_t>, kClasses> counts{};
  };

  static std::int64_t number_at(TimePoint time) { return time.time_since_epoch() / kSpan; }

  static std::size_t class_of(Duration time) {
    constexpr std::uint64_t kLeast = std::uint64_t{1} << kFirstOctave;
    constexpr std::uint64_t kMost = (std::uint64_t{1} << (kFirstOctave + kOctaves)) - 1;
    const auto ns =
        std::clamp(static_cast<std::uint64_t>(std::max<Duration::rep>(time.count(), 0)), kLeast, kMost);
    const int octave = static_cast<int>(std::bit_width(ns)) - 1;
    const std::uint64_t part = (ns >> (octave - kPartBits)) - (1U << kPartBits);
    return (static_cast<std::size_t>(octave - kFirstOctave) << kPartBits) + static_cast<std::size_t>(part);
  }

  // Returns the middle of the class that holds the duration of this rank, the shortest being 0 [s].
  static double quantile(const std::array<std::uint64_t, kClasses>& counts, std::uint64_t rank) {
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < kClasses; ++i) {
      below += counts[i];
      if (below > rank) return middle_of(i);
    }
    return 0.0;
  }

  static double middle_of(std::size_t index) {
    const double part = static_cast<double>(index % (1U << kPartBits)) + 0.5;
    const std::size_t octave = kFirstOctave + (index >> kPartBits);
    return 1e-9 * static_cast<double>(std::uint64_t{1} << octave) * (1.0 + part / (1U << kPartBits));
  }

  std::array<Window, 2> windows_{};  // the present one and the one before
};

}  // namespace orca
