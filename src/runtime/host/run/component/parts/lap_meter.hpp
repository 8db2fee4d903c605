// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "orca/base/system/task_time.hpp"
#include "orca/host/run_result.hpp"

namespace orca::host {

/// A meter of the processor time that the laps of one component take, in classes that are 3 to 6 % wide.
///
/// Thread contract: the component's strand; summary() once that has ended.
class LapMeter {
 public:
  void begin() { began_ = task_time(); }
  void end() { add(task_time() - began_); }

  void add(Duration time) {
    const auto ns = static_cast<std::uint64_t>(std::max<Duration::rep>(time.count(), kClasses));
    const auto octave = static_cast<std::size_t>(std::bit_width(ns) - 1);
    const std::uint64_t part = (ns >> (octave - kClassBits)) - kClasses;
    ++counts_[octave * kClasses + part];
    ++laps_;
    total_ += time;
  }

  [[nodiscard]] LapTimes summary() const {
    LapTimes times{laps_, to_seconds(total_), {}};
    if (laps_ == 0) return times;
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      below += counts_[i];
      while (times.quantiles.size() < kQuantiles &&
             below * (kQuantiles - 1) >= wanted(times.quantiles.size()))
        times.quantiles.push_back(middle_of(i));
    }
    return times;
  }

 private:
  static constexpr int kClassBits = 4;
  static constexpr std::uint64_t kClasses = 1 << kClassBits;  // in each octave
  static constexpr std::size_t kQuantiles = LapTimes::kQuantiles;

  // Returns the number of laps, times the number of parts, that must not be longer than this quantile.
  [[nodiscard]] std::uint64_t wanted(std::size_t quantile) const {
    return std::max<std::uint64_t>(quantile * laps_, kQuantiles - 1);
  }

  // Returns the middle of a class [s].
  static double middle_of(std::size_t index) {
    const std::size_t octave = index / kClasses;
    const double part = static_cast<double>(index % kClasses) + 0.5;
    return 1e-9 * static_cast<double>(std::uint64_t{1} << octave) *
           (1.0 + part / static_cast<double>(kClasses));
  }

  Duration began_{0};
  std::array<std::uint64_t, 64 * kClasses> counts_{};
  std::uint64_t laps_ = 0;
  Duration total_{0};
};

}  // namespace orca::host
