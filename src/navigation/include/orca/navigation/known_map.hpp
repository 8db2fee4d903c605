// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/lattice.hpp"
#include "orca/navigation/particles.hpp"
#include "orca/navigation/scan_match.hpp"
#include "orca/navigation/surface.hpp"

namespace orca::nav {

/// A map of cells as people keep it.
struct FloorGrid {
  static constexpr std::uint8_t kUnknown = 255;  ///< As all above kMost.
  static constexpr std::uint8_t kMost = 100;     ///< [%]
  static constexpr std::uint8_t kOccupied = 50;  ///< [%] from which a cell counts as occupied.

  Lattice lattice;
  std::vector<std::uint8_t>
      cells;  ///< [%] lattice.size() of them: 0 free to kMost occupied; above: not known.

  [[nodiscard]] bool occupied(Cell cell) const {
    return holds(cell) && at(cell) >= kOccupied && at(cell) <= kMost;
  }
  [[nodiscard]] bool free(Cell cell) const { return holds(cell) && at(cell) < kOccupied; }

 private:
  [[nodiscard]] bool holds(Cell cell) const { return lattice.holds(cell); }
  [[nodiscard]] std::uint8_t at(Cell cell) const { return cells[lattice.index(cell)]; }
};

/// Returns the surfaces of a grid: the middles of the occupied cells beside free ones, laid on the line through their neighbours that face the
/// same way. A thin wall that is free on both sides has two surfaces. A cell whose neighbours lie on no line has no normal.
/// @thread  pure function; any thread.
[[nodiscard]] std::vector<SurfacePoint> surface_of(const FloorGrid& grid);

/// The first thing that a map lets a beam see.
struct Sight {
  enum class End : std::uint8_t { wall, unknown, nothing };
  double range = 0.0;  ///< [m] to there.
  End end = End::nothing;
};

/// How the echoes of a scan lie in a map, seen from a pose. The counts are of echoes.
struct Explanation {
  double hits = 0.0;    ///< On a surface of the map.
  double shorts = 0.0;  ///< In front of the next one: a person, or what the map does not know.
  double longs = 0.0;   ///< Behind it: there the map is wrong, or the pose.
  double fit = 0.0;  ///< [1] mean closeness: 1 on a surface, 0.5 at 10 cm from it. Those in front count half.
  /// [1] The same, where echoes count the less the nearer they are: a crate before the robot takes many beams, however little of the
  /// room it is.
  /// As `fit` where so much is hidden that the rest says nothing.
  double fit_of_room = 0.0;

  /// Returns how many echoes count: those that stand in front by a half, those where the map knows nothing not at all.
  [[nodiscard]] double all() const { return hits + longs + 0.5 * shorts; }
  /// Returns the share [1] of them that the map explains.
  [[nodiscard]] double share() const { return all() > 0.0 ? hits / all() : 0.0; }
};

/// A map in which a robot can be looked for.
///
/// Thread contract: const functions from any thread.
class KnownMap {
 public:
  static constexpr double kReach = 2.0;          ///< [m]
  static constexpr int kMostAlong = 40'000;      ///< [cells]
  static constexpr double kMostExtent = 2000.0;  ///< [m]
  static constexpr double kOff =
      0.12;  ///< [m] by which an echo may be off a surface of the map and still lie on it.

  /// @pre  grid.cells.size() = grid.lattice.size() > 0; the side of a cell is from 1 mm to 10 m; neither side of the map is longer than
  ///       kMostAlong and kMostExtent. It takes 6 bytes for each 5 cm by 5 cm of the rectangle around its surfaces.
  explicit KnownMap(FloorGrid grid);

  [[nodiscard]] const FloorGrid& grid() const { return grid_; }
  /// Returns the distance [m] from a place to the middle of the next occupied cell, to within 1 cm and a cell: the likelihood field
  /// of Thrun, Burgard and Fox 2005, 6.4. At most kReach, which is also that of a place outside the map.
  [[nodiscard]] double distance(Vec2 place) const;
  /// Returns whether the map says that nothing is at a place.
  [[nodiscard]] bool free(Vec2 place) const { return grid_.free(grid_.lattice.cell_at(place)); }
  /// Returns how far one sees from a place, at most to `most` [m].
  /// @param ahead  unit vector.
  [[nodiscard]] Sight look(Vec2 from, Vec2 ahead, double most) const;
  /// Says how the echoes of a scan lie in the map.
  /// @param scan    robot frame.  @param sensor  where it was taken from, robot frame.
  [[nodiscard]] Explanation explain(std::span<const SurfacePoint> scan, Vec2 sensor, const Pose2& X_MR) const;

  /// Returns how far a place is in front of or behind the next surface [m]; kReach if there is none near.
  [[nodiscard]] double distance_to_surface(Vec2 place) const;

  [[nodiscard]] const SurfaceMap& surface() const { return surface_; }
  [[nodiscard]] const ScanSearch& search() const { return search_; }
  /// Returns the corners, as ScanSearch::bound() takes them, of all blocks of its top level in which the map is free somewhere, row by row.
  [[nodiscard]] const std::vector<Cell>& free_blocks() const { return free_blocks_; }

 private:
  static constexpr double kSoft = 0.1;    // [m]
  static constexpr double kBeside = 0.2;  // [m]
  static constexpr double kNear = 3.0;    // [m] up to which beams lie denser on a surface than others count
  static constexpr double kRest = 0.2;    // [1] of the echoes, by which a place is judged at least

  FloorGrid grid_;
  std::vector<std::uint8_t> distance_;  // [cm] to the next occupied cell
  std::vector<std::uint8_t> clear_;     // [cm] to the next one that is not free
  SurfaceMap surface_;
  ScanSearch search_;
  std::vector<Cell> free_blocks_;
};

/// Returns how likely a scan is at a pose, by how near its echoes are to what is occupied; those beside each other count as one in three.
/// @param scan  robot frame; about sixty points are enough.
/// @return [1] at least 1e-100.
/// @thread  pure function; any thread.
[[nodiscard]] double likelihood(std::span<const SurfacePoint> scan, const KnownMap& map, const Pose2& X_MR);

/// By how much better a scan must fit at one place than at another to speak for it.
struct FitMargin {
  double apart = 0.02;  ///< [1] shares that differ by less say nothing.
  double evidence =
      80.0;  ///< [1/1] logarithm of the odds by each share that a place explains more of a scan than another.
};

/// [m] MatchOptions::reach about a place that is known well.
inline constexpr double kCloseReach = 0.2;

/// Returns where a robot is whose scan was laid at a place that a search has found: known by 10 cm and 4 degrees at worst, as the search looks
/// more closely.
/// @thread  pure function; any thread.
[[nodiscard]] PoseSpread spread_of(const ScanMatch& laid);

/// Lays a scan on a map, near where the robot should be. A place away from there must explain clearly more of the scan, and the more the
/// farther it is: a piece of furniture that was moved explains a little more where it stood.
/// @param scan   robot frame.
/// @param prior  where the robot should be, by its wheels.
/// @return nothing, if fewer than ten points find a surface.
/// @thread  pure function; any thread.
[[nodiscard]] std::optional<ScanMatch> lay_near(std::span<const SurfacePoint> scan, const KnownMap& map,
                                                const PoseSpread& prior, const MatchOptions& options,
                                                const FitMargin& margin);

}  // namespace orca::nav
