// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <numbers>
#include <span>

#include "orca/geometry/vec2.hpp"

/// VFH+ as pure functions of any thread: what the robot's surroundings look like in each direction.
///
/// Equations and their numbers are those of I. Ulrich and J. Borenstein, "VFH+: Reliable Obstacle Avoidance for Fast
/// Mobile Robots", Proc. IEEE Int. Conf. on Robotics and Automation, 1998. Places have the robot's centre as their
/// origin and axes that do not turn with the robot; directions are in the same axes [rad], counter-clockwise positive.
namespace orca::vfh {

inline constexpr std::size_t kSectors = 72;
inline constexpr double kSector = 2.0 * std::numbers::pi / static_cast<double>(kSectors);  ///< [rad] alpha.

/// A place that may be occupied: an active cell of the paper's grid, whatever its size.
struct Cell {
  Vec2 place;              ///< [m] from the robot's centre.
  double certainty = 1.0;  ///< [0, 1] of being occupied: c.
};

/// The robot among the cells.
struct Surroundings {
  double radius = 0.0;  ///< [m] r_{r+s}: of the circle that holds the robot, and the safety distance.
  double window = 0.0;  ///< [m] distance from the robot's centre beyond which cells do not count, above 0.
  double near_weight =
      1.0;  ///< a: magnitude of a certain cell at the robot's centre; at the window's rim it is 1.
};

/// The limits between which a sector stays as it was.
struct Thresholds {
  double low = 0.0;   ///< tau_low: a sector of less is free.
  double high = 0.0;  ///< tau_high: a sector of more is blocked.
};

/// The present motion of the robot.
struct Motion {
  double heading = 0.0;  ///< [rad] theta.
  double radius = 0.0;   ///< [m] r: of the tightest arc that it can drive now; 0: it turns on the spot.
};

using Densities = std::array<double, kSectors>;  ///< One number a sector; sector k looks to k * kSector.
using Blocked = std::bitset<kSectors>;           ///< Whether a sector is blocked.

/// Returns the distance [rad] from one direction to another, at most pi: equation 15.
[[nodiscard]] double apart(double one, double other);

/// Returns the weight of a cell: equations 2 and 3, c^2 (a - b d^2), where b is such that a certain cell at the rim of
/// the window has magnitude 1. Beyond the rim: 0.
[[nodiscard]] double magnitude(const Cell& cell, const Surroundings& around);

/// Returns the angle [rad] to either side of a cell in which the robot, driving straight on, would come too near to
/// it: equation 4, asin(r_{r+s} / d). A cell nearer than r_{r+s} blocks all directions towards it: pi / 2.
[[nodiscard]] double enlargement(double distance, double radius);

/// Returns the primary polar histogram, equations 5 and 6: the sum of the magnitudes of all cells whose enlarged angle
/// covers the middle of the sector.
[[nodiscard]] Densities primary_histogram(std::span<const Cell> cells, const Surroundings& around);

/// Returns the binary polar histogram, equation 7: between the thresholds a sector stays as it was `before`.
[[nodiscard]] Blocked binary_histogram(const Densities& densities, const Blocked& before,
                                       const Thresholds& thresholds);

/// Returns the masked polar histogram, equations 8 to 11: directions are blocked too if the robot, on its tightest arc
/// towards them, would come too near to a cell.
///
/// A robot that turns on the spot has no such arc: nothing is masked. Cells beyond the window do not count.
[[nodiscard]] Blocked masked_histogram(const Blocked& binary, std::span<const Cell> cells,
                                       const Surroundings& around, const Motion& motion);

}  // namespace orca::vfh
