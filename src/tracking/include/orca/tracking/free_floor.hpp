// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "orca/geometry/vec2.hpp"
#include "orca/navigation/beams.hpp"

namespace orca::tracking {

/// The floor around a robot on which its scans have seen nothing of late. What is seen on it now has come there since.
///
/// A cell is free after kSure scans in a row have looked through it, none of which saw an echo in it or in a cell beside it. Cells that
/// touch an echo are left alone, since beams graze the edges of what stands there.
///
/// The memory is a square of kSide * kCells that repeats over the plane: a place takes the cell of one that is that far away.
///
/// Thread contract: as for a container.
/// @source  Wang, Thorpe, Thrun, Hebert and Durrant-Whyte, "Simultaneous Localization, Mapping and Moving Object Tracking", IJRR 26(9),
///          2007: a reading in space that was seen free before is one of something that moves.
class FreeFloor {
 public:
  static constexpr double kSide = 0.1;    ///< [m] of a cell.
  static constexpr int kCells = 256;      ///< in a row.
  static constexpr double kLately = 1.2;  ///< [s]
  static constexpr int kSure = 2;         ///< scans

  FreeFloor() : cells_(static_cast<std::size_t>(kCells) * kCells) {}

  /// Takes a scan. @param time [s]  at which it was taken; times only grow.
  void see(std::span<const nav::Beam> scan, double time);
  /// Returns whether beams that ended at something farther away have looked through a place in the last kLately.
  [[nodiscard]] bool was_free(Vec2 place, double time) const;
  /// Returns whether beams without any echo have. They may have missed what reflects them elsewhere, such as a wall along which they graze.
  [[nodiscard]] bool was_open(Vec2 place, double time) const;
  /// Returns whether the last scan looked through a place.
  [[nodiscard]] bool is_seen_free(Vec2 place) const;

 private:
  struct Cell {
    int column = std::numeric_limits<int>::max();
    int row = 0;
    double free_at = -std::numeric_limits<double>::infinity();  // [s]
    double open_at = -std::numeric_limits<double>::infinity();  // [s]
    std::uint32_t looked_through = 0;                           // the last scan that did
    std::uint32_t echoed = 0;  // the last scan with an echo in it or beside it
    int in_a_row = 0;          // scans that looked through it
  };
  [[nodiscard]] const Cell* find(Vec2 place) const;
  Cell& at(int column, int row);
  void block(Vec2 place, double room);
  void block_surface(const nav::Beam& from, const nav::Beam& to);
  static bool is_open(std::span<const nav::Beam> scan, std::size_t i);
  void block_faded(std::span<const nav::Beam> scan);
  void look_through(const nav::Beam& beam, double time);

  std::vector<Cell> cells_;
  std::uint32_t scan_ = 0;
};

}  // namespace orca::tracking
