// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <tuple>
#include <utility>

#include "orca/base/time.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace orca {

using ScanPtr = ObjectPtr<idl::LaserRangeReadings>;

/// Returns when the last beam of a scan was taken.
[[nodiscard]] inline TimePoint last_beam_of(const idl::LaserRangeReadings& scan) {
  const double sweep = std::max(0.0, scan.time_increment()) * static_cast<double>(scan.ranges().size());
  return to_time_point(scan.stamp()) + from_seconds(sweep);
}

/// Scans that wait until it is known where the robot was at their last beam. There are kMost at most; the oldest is dropped.
class WaitingScans {
 public:
  void add(ScanPtr scan) {
    if (scans_.size() == kMost) scans_.pop_front();
    scans_.push_back(std::move(scan));
  }
  void clear() { scans_.clear(); }
  /// Names what it consists of.
  [[nodiscard]] auto state() { return std::tie(scans_); }

  /// Returns the newest scan whose last beam was taken by this time, and drops it with all that are older; null: none was.
  ScanPtr take_until(TimePoint time) {
    ScanPtr found;
    while (!scans_.empty() && last_beam_of(*scans_.front()) <= time) {
      found = std::move(scans_.front());
      scans_.pop_front();
    }
    return found;
  }

 private:
  static constexpr std::size_t kMost = 8;
  std::deque<ScanPtr> scans_;  // oldest first
};

}  // namespace orca
