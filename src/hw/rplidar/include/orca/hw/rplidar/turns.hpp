// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/hw/rplidar/node.hpp"

namespace orca::hw::rplidar {

/// A whole turn, as beams at fixed angles. Beam i looks at pi - i * 2 pi / number: the first one behind, then clockwise as the
/// scanner turns, so that the middle one looks ahead. A plain value.
struct Turn {
  TimePoint stamp{};           ///< When its first beam was measured.
  Duration period{0};          ///< [s] of the turn.
  std::vector<double> ranges;  ///< [m] one per beam; infinite: no echo.
};

/// The turns that the points of a scan make. A beam has the range of the nearest point that lies closer to it than to other
/// beams. Between two points more than a beam apart, a beam without a point has the shorter range of the beams beside the gap.
///
/// A turn in which points were lost is no turn: they were if the angle goes forward by more than kWidestGap from one point to the
/// next. Angles of points with echo are corrected by the scanner, up to 8 degrees earlier, and those of points without echo are not;
/// where that alone makes a gap, at the edge of what has no echo, and before what is nearer, nothing was lost. A turn that takes
/// longer than kLongestTurn, or in which no point came for kLongestPause, is none either.
///
/// Thread contract: not synchronised.
class TurnCollector {
 public:
  static constexpr double kWidestGap = 0.105;  ///< [rad] about 6 deg, beside what corrections make.
  static constexpr Duration kLongestTurn = 1s;
  static constexpr Duration kLongestPause = 100ms;

  /// @param beams  of a turn, at least 4.
  explicit TurnCollector(std::size_t beams);

  /// Takes the next point.
  /// @param stamp  when it was measured.
  /// @return the turn that ended before it, valid until the next call; null: none has, or points of it were lost.
  const Turn* add(const Point& point, TimePoint stamp);

  /// Forgets what it has, for a scan that begins anew.
  void restart();

  /// Returns how many turns had lost points or took too long since the last restart().
  [[nodiscard]] std::uint64_t incomplete() const { return incomplete_; }

 private:
  void give_up();
  [[nodiscard]] double place_of(double angle) const;
  void begin(TimePoint stamp, bool lost);
  void mark(double place, const Point& point);
  [[nodiscard]] bool finish(TimePoint end);
  void fill_gaps();

  const std::size_t beams_;
  Turn turn_;
  Turn finished_;
  std::vector<bool> measured_;
  double place_ = 0.0;             // of the last point, in beams
  std::optional<double> range_{};  // of the last point
  TimePoint stamp_{};              // of the last point
  bool collects_ = false;          // a turn from its beginning on
  bool has_lost_ = false;          // points of that turn
  bool has_place_ = false;
  std::uint64_t incomplete_ = 0;
};

}  // namespace orca::hw::rplidar
