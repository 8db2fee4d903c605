// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/lattice.hpp"
#include "orca/navigation/pose_graph.hpp"
#include "orca/navigation/surface.hpp"

namespace orca::nav {

/// How a scan lies in a map.
struct ScanMatch {
  Pose2 X_MR;  ///< The pose of the frame in which the scan is given.
  PoseInformation
      information;      ///< By how sharply the points hold it, in that frame. Along a corridor it is small.
  double share = 0.0;   ///< [1] of the points that lie on the map, within MatchOptions::inlier.
  double fit = 0.0;     ///< [1] the same, where each point counts the less, the farther it is off.
  double spread = 0.0;  ///< [m] root of the mean square of those from the map's surfaces.
};

/// How a scan is laid into a map.
struct MatchOptions {
  double reach = 0.4;   ///< [m] in which a point looks for its surface at first.
  double inlier = 0.1;  ///< [m] in which it looks at last.
  int iterations = 50;
  double still = 1e-5;  ///< [m], [rad] a step that ends it.
  double error = 0.03;  ///< [m] by which a point may be off its surface: that of the sensor and of the map.
  /// By how many readings an error is shared: those of one wall are wrong together, so a hundred do not say it ten times as well as one.
  double together = 10.0;
};

/// Moves a scan to where its points lie on the surfaces of the map, beginning at a guess: points to lines, each pulling the less the farther
/// it is off. Points without a normal in the map pull towards the point.
/// @param held  how sharply the guess is known, in its own frame: by that much it pulls back. Without it a few points on a piece of furniture that
///              was moved draw the scan along a corridor, whose walls do not hold it there. The information that is returned is that of the scan alone.
/// @return nothing, if fewer than ten points find a surface.
/// Thread contract: pure; any thread.
/// @source  Censi, "An ICP variant using a point-to-line metric", ICRA 2008, for the distance; the pulls are Cauchy's.
[[nodiscard]] std::optional<ScanMatch> refine(std::span<const SurfacePoint> scan, const SurfaceMap& map,
                                              const Pose2& guess, const MatchOptions& options = {},
                                              const PoseInformation& held = {});

/// Where to look for a scan.
struct SearchWindow {
  Pose2 middle;       ///< The scan's frame in that of the map.
  double way = 0.5;   ///< [m] to each side of it, in x and in y.
  double turn = 0.5;  ///< [rad] to each side; pi: all directions.
};

/// A pose and how well a scan fits there.
struct Found {
  Pose2 X_MR;
  double score =
      0.0;  ///< [1] mean over the points of exp(-d2 / 2 s2), where d is the distance to the nearest point of the map and s 7 cm.
};

/// Finds the best place of a scan in a map within a window, on a grid of kSide and so many directions that the farthest point moves by a cell
/// from one to the next. It misses none: blocks of places are ruled out only by a bound that no place in them exceeds.
///
/// Thread contract: const functions from any thread.
/// @source  Olson, "Real-time correlative scan matching", ICRA 2009; the bounds: Hess and others, "Real-time loop closure in 2D LIDAR SLAM",
///          ICRA 2016.
class ScanSearch {
 public:
  static constexpr double kSide = 0.05;  ///< [m] of a cell.

  /// @param points  of the map, its frame.
  /// @pre  they lie within some hundred metres: it keeps six bytes for each cell of the rectangle around them.
  explicit ScanSearch(std::span<const SurfacePoint> points);

  /// @return the best place with at least that score; nothing, if there is none.
  [[nodiscard]] std::optional<Found> best(std::span<const SurfacePoint> scan, const SearchWindow& window,
                                          double least_score) const;
  /// Returns the score of a scan at a pose, from the finest grid.
  [[nodiscard]] double score(std::span<const SurfacePoint> scan, const Pose2& X_MR) const;

  static constexpr int kLevels = 6;       ///< Levels of blocks: those of one have sides of 2^level cells.
  static constexpr double kFull = 255.0;  ///< Value of a cell with a point of the map.
  [[nodiscard]] const Lattice& lattice() const { return lattice_; }
  /// Returns the greatest sum of values that the points of a scan can have, in whichever place of a block it is; at level 0 that which they have.
  /// @param turned  the cells of the points, if the scan was taken at the middle of cell (0, 0).
  /// @param corner  the cell of least x and y of the block.
  [[nodiscard]] int bound(std::span<const Cell> turned, Cell corner, int level) const {
    const std::vector<std::uint8_t>& field = levels_[static_cast<std::size_t>(level)];
    int sum = 0;
    for (const Cell& cell : turned) {
      const Cell at{cell.column + corner.column, cell.row + corner.row};
      if (lattice_.holds(at)) sum += field[lattice_.index(at)];
    }
    return sum;
  }

 private:
  struct Search;

  // For each cell the greatest value in the square of 2^level cells to the right and up from it.
  std::array<std::vector<std::uint8_t>, kLevels> levels_;
  Lattice lattice_;
};

}  // namespace orca::nav
