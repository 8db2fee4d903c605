// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include "orca/geometry/vec2.hpp"

/// ND+ as pure functions of any thread: the nearness diagram, its gaps and the regions between them.
///
/// Terms are those of J. Minguez and L. Montano, "Nearness Diagram (ND) Navigation: Collision Avoidance in Troublesome
/// Scenarios", IEEE Trans. Robotics and Automation 20(1), 2004, and of J. Minguez, J. Osuna and L. Montano, "A 'divide and
/// conquer' strategy based on situations to achieve reactive collision avoidance in troublesome scenarios", IEEE Int. Conf. on
/// Robotics and Automation, 2004. Places and directions are in the robot's frame: x forward [m], counter-clockwise positive
/// [rad].
namespace orca::nd {

inline constexpr std::size_t kSectors = 144;
inline constexpr double kSector = 2.0 * std::numbers::pi / static_cast<double>(kSectors);  ///< [rad]

/// The distance [m] from the robot's centre to the nearest thing in each sector; infinity: there is nothing. Sector k looks to
/// k * kSector.
using Depths = std::array<double, kSectors>;

/// Returns the direction [rad] in the middle of a sector, in (-pi, pi].
[[nodiscard]] double direction_of(std::size_t sector);

/// Returns the sector that holds a direction [rad].
[[nodiscard]] std::size_t sector_of(double direction);

/// Returns the sector that lies `steps` sectors to the left of another one.
[[nodiscard]] constexpr std::size_t left_of(std::size_t sector, std::size_t steps) {
  return (sector + steps) % kSectors;
}

/// Returns the depths that echoes make.
/// @param joined [m]  echoes nearer to each other than this belong to one surface, which fills the sectors between them.
[[nodiscard]] Depths depths(std::span<const Vec2> echoes, double joined);

/// The sectors between two gaps that follow each other: a valley of the diagram, if it has a rising gap.
struct Region {
  std::size_t right = 0;  ///< Its rightmost sector.
  std::size_t width = 0;  ///< Number of its sectors, counted to the left; kSectors: all.
  bool rises_right =
      false;  ///< Whether the gap at its right side is a rising one: the region is deeper than what stands there.
  bool rises_left = false;  ///< The same of its left side.

  [[nodiscard]] std::size_t left() const { return left_of(right, width - 1); }
  [[nodiscard]] bool holds(std::size_t sector) const {
    return (sector + kSectors - right) % kSectors < width;
  }
  /// Returns the direction [rad] in the middle between its borders, in (-pi, pi].
  [[nodiscard]] double middle() const;
};

/// Returns the regions that have a rising gap, from sector 0 on, counted to the left. If nothing is seen at all, all sectors are one
/// region.
/// @param jump [m]  neighbours that differ in depth by more than this have a gap between them: the robot's diameter.
[[nodiscard]] std::vector<Region> regions(const Depths& depths, double jump);

}  // namespace orca::nd
