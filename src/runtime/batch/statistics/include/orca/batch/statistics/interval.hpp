// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::batch {

/// A closed interval, in the unit of what it estimates. Those of this library are made for a confidence of 95 %.
struct Interval {
  double low = 0.0;
  double high = 0.0;

  /// Returns whether `value` lies in it; its ends belong to it.
  [[nodiscard]] bool contains(double value) const { return low <= value && value <= high; }
  friend bool operator==(const Interval&, const Interval&) = default;
};

}  // namespace orca::batch
