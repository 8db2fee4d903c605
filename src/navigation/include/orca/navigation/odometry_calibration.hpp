// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/geometry/error_guess.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::nav {

/// A piece of a drive: what the base's odometry counted, and how the base moved by something that knows better, such as scans.
struct DrivenPiece {
  double way = 0.0;      ///< [m] counted, forward positive.
  double turn = 0.0;     ///< [rad] counted, positive to the left, however far.
  double covered = 0.0;  ///< [m] counted, back and forth alike.
  double turned = 0.0;   ///< [rad] counted, both ways alike.
  Pose2 X_AB;            ///< The base at the end, seen from the beginning; turned by less than half a circle.
};

/// The counts of a base's odometry since its beginning.
struct Counted {
  Pose2 X_OB;            ///< The base in the frame of its odometry.
  double way = 0.0;      ///< [m] forward positive.
  double turn = 0.0;     ///< [rad] positive to the left, however far.
  double covered = 0.0;  ///< [m] back and forth alike.
  double turned = 0.0;   ///< [rad] both ways alike.
};

/// All that an odometry has counted, by time.
///
/// Thread contract: not synchronised.
class CountHistory {
 public:
  /// Adds a reading of the odometry. One that is not newer than the one before is left out.
  void add(TimePoint stamp, const Pose2& X_OB);
  /// Returns what was counted at a time, between two readings in proportion; nothing, before the first and after the last.
  [[nodiscard]] std::optional<Counted> at(TimePoint stamp) const;

 private:
  std::vector<TimePoint> stamps_;
  std::vector<Counted> counted_;
};

/// Returns the piece of a drive between two instants.
/// @param X_AB  the base at the end, truly, seen from where it was at the beginning.
[[nodiscard]] DrivenPiece piece_between(const Counted& begin, const Counted& end, const Pose2& X_AB);

/// A figure that was measured, and its standard deviation.
struct Measured {
  double value = 0.0;
  double deviation = 0.0;
};

/// The factors between a base's motion and what its odometry counts: it drives `distance_scale` times the way, and turns by `turn_scale` times the angle and
/// `turn_per_metre` times the way more. A wrong diameter of both wheels makes the first, a wrong track the second, unequal wheels the third.
struct OdometryCalibration {
  Measured distance_scale{1.0, 0.0};  ///< [1]
  Measured turn_scale{1.0, 0.0};      ///< [1]
  Measured turn_per_metre{0.0, 0.0};  ///< [rad/m]
  WheelErrorGuess left;    ///< The uncertainty once these are corrected: the deviations, and slip as it was.
  std::size_t pieces = 0;  ///< Their number in the drive.

  /// Returns the right wheel's diameter over the left one's.
  /// @param track [m]  as the controller believes, > 0.
  [[nodiscard]] double wheel_ratio(double track) const;
  /// Returns the true track over the controller's.
  [[nodiscard]] double track_ratio() const { return distance_scale.value / turn_scale.value; }
};

/// Finds the calibration that explains how a differential base moved best: least squares in which a piece counts the less, the farther it is off, over
/// stretches of 8 to 64 pieces, of which those are taken that give the smallest deviation, since errors of single poses are lost in long ones and turns
/// to both sides cancel there.
/// @param pieces  of one drive, in order.
/// @param track [m]  as the controller believes, > 0.
/// @errors  failed_precondition if the drive does not show it: fewer than 240 pieces, 10 m of way or two full turns.
/// @thread  pure function; any thread.
[[nodiscard]] Result<OdometryCalibration> calibrate(std::span<const DrivenPiece> pieces, double track);

/// A square that a base has driven by something that knows better than its odometry, as it ended.
struct SquareEnd {
  bool clockwise = false;
  Vec2
      off;  ///< [m] where the base was, less where its odometry put it; in the frame in which the square began, x along its first leg.
};

/// The result of the UMBmark.
struct SquareResult {
  Vec2 clockwise;            ///< [m] mean of the ends of squares to the right,
  Vec2 counterclockwise;     ///< and to the left.
  double error = 0.0;        ///< [m] the larger distance of the two: the systematic error of the base.
  double wheel_ratio = 1.0;  ///< Right diameter over left: E_d of the paper.
  double track_ratio = 1.0;  ///< True track over the controller's: E_b.
};

/// Evaluates squares that were driven both ways round.
/// @param side [m]  of the squares, > 0. @param track [m]  as the controller believes, > 0.
/// @return nothing, if there is none of either way.
/// @thread  pure function; any thread.
/// @source  Borenstein and Feng, "Measurement and correction of systematic odometry errors in mobile robots", IEEE Transactions on Robotics
///          and Automation 12(6), 1996. There the base drives by its odometry, and its true way is no square; here that which it counts is none.
///          Their formulas are of first order, and are applied again to the ends that they leave.
[[nodiscard]] std::optional<SquareResult> evaluate_squares(std::span<const SquareEnd> squares, double side,
                                                           double track);

}  // namespace orca::nav
