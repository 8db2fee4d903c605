// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/base/random.hpp"
#include "orca/navigation/map_localizer.hpp"
#include "orca/navigation/slam.hpp"

namespace orca::slam {

/// Finds where a robot is in a map that was made before, as a Localizer does, before the map goes on: what is laid on the wrong place bends it for ever.
/// So it must have known where the robot is on the last metre.
///
/// Thread contract: the component's strand.
class MapEntry {
 public:
  /// @param slam  has made the map: at least a node.
  /// @param last  whether the robot may still be where it was last.
  MapEntry(const nav::Slam& slam, const RandomStream& random, bool last);

  /// Goes on to where odometry is now.
  void move(const nav::Reckoned& now);
  /// Takes a scan.
  /// @pre  move() was called for when it was taken.
  void see(const nav::RobotScan& scan);

  /// Returns where the robot is, map frame; nothing: that is not known.
  /// @param now  as move() was given it.
  [[nodiscard]] std::optional<nav::PoseSpread> where(const nav::Reckoned& now) const;
  /// Returns whether that has been known for so long that the map can go on.
  [[nodiscard]] bool is_sure() const { return known_way_ >= kProof && !localizer_.searches(); }

 private:
  static constexpr double kProof = 1.0;  // [m]

  nav::MapLocalizer localizer_;
  std::optional<nav::PoseSpread> last_;
  std::optional<nav::Reckoned> before_;
  double known_way_ = 0.0;  // [m] driven since it has been known where the robot is
};

}  // namespace orca::slam
