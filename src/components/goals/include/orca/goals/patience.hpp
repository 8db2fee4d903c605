// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <limits>
#include <tuple>

#include "orca/base/time.hpp"

namespace orca::go {

/// The watch over the progress towards one point. Progress is to come nearer than ever before, by 0.1 m at
/// least.
class Patience {
 public:
  /// Starts again: the point is another one.
  void begin() { nearest_ = std::numeric_limits<double>::infinity(); }

  /// Takes note of the present distance to the point [m].
  /// @return for how long there has been no progress [s].
  double note(double distance, TimePoint now) {
    if (distance < nearest_ - kProgress) {
      nearest_ = distance;
      since_ = now;
    }
    return to_seconds(now - since_);
  }

  /// Returns the smallest distance so far [m], to within 0.1 m.
  [[nodiscard]] double nearest() const { return nearest_; }

  /// Returns all of it, to be passed on to another version of Goto.
  auto state() { return std::tie(nearest_, since_); }

 private:
  static constexpr double kProgress = 0.1;  // [m]

  double nearest_ = std::numeric_limits<double>::infinity();
  TimePoint since_{};
};

}  // namespace orca::go
