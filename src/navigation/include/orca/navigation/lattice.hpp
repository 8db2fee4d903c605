// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "orca/geometry/vec2.hpp"

namespace orca::nav {

/// A cell of a lattice: columns count along x, rows along y.
struct Cell {
  int column = 0;
  int row = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// The division of a rectangle of the plane into square cells, row by row from its corner of least x and y.
///
/// A plain value; its functions may be called from any thread.
struct Lattice {
  Vec2 corner;         ///< [m] of least x and y.
  double side = 0.05;  ///< [m] of a cell.
  int columns = 0;
  int rows = 0;

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  [[nodiscard]] bool holds(Cell cell) const {
    return cell.column >= 0 && cell.row >= 0 && cell.column < columns && cell.row < rows;
  }
  /// Returns the place of a cell in an array of size(). @pre holds(cell).
  [[nodiscard]] std::size_t index(Cell cell) const {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(cell.column);
  }
  [[nodiscard]] Cell cell_of(std::size_t index) const {
    return {static_cast<int>(index % static_cast<std::size_t>(columns)),
            static_cast<int>(index / static_cast<std::size_t>(columns))};
  }
  /// Returns the cell around a point, which need not be one that the lattice holds.
  /// @pre  the point is within 1e8 cells of the corner.
  [[nodiscard]] Cell cell_at(Vec2 point) const {
    return {whole_below((point.x - corner.x) / side), whole_below((point.y - corner.y) / side)};
  }
  [[nodiscard]] Vec2 middle_of(Cell cell) const {
    return {corner.x + (cell.column + 0.5) * side, corner.y + (cell.row + 0.5) * side};
  }

 private:
  // std::floor() for numbers that an int holds: without SSE 4.1 that is many instructions.
  static int whole_below(double number) {
    const int whole = static_cast<int>(number);
    return number < whole ? whole - 1 : whole;
  }
};

namespace detail {

/// The walls between the cells along one axis, in the order in which a line crosses them.
class Walls {
 public:
  Walls(double from, double way, double corner, double side, int number)
      : step_(way < 0.0 ? -1 : 1),
        next_(way != 0.0 ? (corner + (number + (way < 0.0 ? 0 : 1)) * side - from) / way : kNever),
        every_(way != 0.0 ? side / std::fabs(way) : kNever) {}

  /// Returns the share [1] of the line before the next wall.
  [[nodiscard]] double next() const { return next_; }
  void cross(int& number) {
    number += step_;
    next_ += every_;
  }

 private:
  static constexpr double kNever = 1e300;
  int step_;
  double next_;
  double every_;
};

}  // namespace detail

/// Calls `visit(cell)` for the cells that the straight line from `from` to `to` crosses, in order, including both
/// ends, until it returns false.
/// @return whether all were visited.
/// @source  Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", Eurographics 1987.
template <typename Visit>
bool walk_line(const Lattice& lattice, Vec2 from, Vec2 to, Visit visit) {
  Cell cell = lattice.cell_at(from);
  const Cell end = lattice.cell_at(to);
  detail::Walls upright(from.x, to.x - from.x, lattice.corner.x, lattice.side, cell.column);
  detail::Walls level(from.y, to.y - from.y, lattice.corner.y, lattice.side, cell.row);
  // Counted, so that rounding cannot lead past the end.
  for (int left = std::abs(end.column - cell.column) + std::abs(end.row - cell.row);; --left) {
    if (!visit(cell)) return false;
    if (left == 0) return true;
    if (cell.row == end.row || (cell.column != end.column && upright.next() < level.next())) {
      upright.cross(cell.column);
    } else {
      level.cross(cell.row);
    }
  }
}

}  // namespace orca::nav
