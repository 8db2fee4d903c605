// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "orca/geometry/vec2.hpp"
#include "orca/navigation/grid_search.hpp"
#include "orca/navigation/lattice.hpp"

namespace orca::nav {

/// A line of straight pieces that a robot follows. Places on it are named by their distance from its start along it.
///
/// A plain value; its const functions may be called from any thread.
class Path {
 public:
  Path() = default;
  /// Points that equal the one before are left out.
  explicit Path(std::span<const Vec2> points);

  /// Names what it consists of.
  [[nodiscard]] auto state() { return std::tie(points_, along_); }

  [[nodiscard]] bool empty() const { return points_.empty(); }
  [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }
  /// Returns its length [m].
  [[nodiscard]] double length() const { return along_.empty() ? 0.0 : along_.back(); }
  /// Returns the point `along` [m] from the start; before the start and behind the end those. @pre not empty.
  [[nodiscard]] Vec2 at(double along) const;
  /// Returns the direction [rad] of the path there. @pre not empty.
  [[nodiscard]] double heading(double along) const;
  /// Returns the place [m] on the part from `from` to `to` [m] that is nearest to a point, the first of equals.
  /// @pre  not empty.
  [[nodiscard]] double nearest(Vec2 point, double from, double to) const;

 private:
  [[nodiscard]] std::size_t piece_at(double along) const;

  std::vector<Vec2> points_;
  std::vector<double> along_;  // [m] from the start to each point
};

/// Replaces parts of a way by straight lines through the cells, as far as these are not dearer than the way.
/// @param costs, forbidden  as for GridSearch.
/// @return the ends of the lines: the middles of cells of the way.
[[nodiscard]] std::vector<Vec2> straightened(const Lattice& lattice, std::span<const std::uint16_t> costs,
                                             const CellWay& way,
                                             std::span<const std::uint8_t> forbidden = {});

/// Rounds the bends of a line: it is cut into pieces of about `spacing` [m], and their inner ends move towards the middle of their
/// neighbours, never into a cell that is dearer than the one before, nor so that a piece leads in a
/// forbidden direction.
/// @pre  `line` has a point; spacing > 0.
[[nodiscard]] Path rounded(const Lattice& lattice, std::span<const std::uint16_t> costs,
                           std::span<const Vec2> line, double spacing, int rounds,
                           std::span<const std::uint8_t> forbidden = {});

/// Returns the cost of a straight line through the cells, as GridSearch counts it; `kImpassable` if a cell is not passable, or not in this
/// direction.
[[nodiscard]] double cost_of_line(const Lattice& lattice, std::span<const std::uint16_t> costs, Vec2 from,
                                  Vec2 to, std::span<const std::uint8_t> forbidden = {});
inline constexpr double kImpassable = 1e300;

}  // namespace orca::nav
