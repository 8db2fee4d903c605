// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <tuple>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/particles.hpp"
#include "orca/navigation/scan_match.hpp"
#include "orca/navigation/surface.hpp"

namespace orca::nav {

/// By how much a laser sees surfaces in front of where the map has them, on the average: a map of cells draws walls too thick or too thin by up
/// to a cell, and a laser's ranges may all be too long. A laser that looks ahead only would take that for a way of the robot. It is
/// learnt from scans that show surfaces on more than one side.
///
/// Thread contract: one thread at a time.
class SurfaceOffset {
 public:
  /// Returns the scan as the map would have it.
  [[nodiscard]] std::vector<SurfacePoint> corrected(std::span<const SurfacePoint> scan) const;

  /// Learns from a scan that was laid on the map.
  /// @param scan  corrected; robot frame.  @param X_MR  as refine() has found it.
  /// @return where the robot is with what was learnt, and how well the scan knows that, as the offset is not known better.
  PoseSpread learn(std::span<const SurfacePoint> scan, const SurfaceMap& map, const Pose2& X_MR,
                   const MatchOptions& options);

  [[nodiscard]] double value() const { return value_; }  ///< [m]
  /// Returns all of it, to be passed on to an object that takes the place of this one's.
  auto state() { return std::tie(value_, variance_); }

 private:
  double value_ = 0.0;
  double variance_ = 0.03 * 0.03;  // [m2]
};

}  // namespace orca::nav
