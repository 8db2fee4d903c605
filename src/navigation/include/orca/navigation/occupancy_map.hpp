// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "orca/navigation/known_map.hpp"
#include "orca/navigation/lattice.hpp"

namespace orca::nav {

/// One beam of a scan.
struct Beam {
  Vec2 from;          ///< of the sensor, map frame.
  Vec2 to;            ///< end of the beam, map frame: where its echo is, or how far it saw nothing.
  bool echo = false;  ///< whether something is at its end.
};

/// A square window of occupancy that moves with the robot. Evidence of each cell is counted: a scan that ends in a cell adds,
/// a scan that looks through it subtracts, both at most once per scan and within bounds. It is the log-odds filter of
/// Elfes 1989 with whole numbers, for a sensor that sees the truth twice as strongly by an echo as by its absence.
///
/// Beams without echo make unknown cells free but do not clear occupied ones: a smooth wall gives no echo at a grazing angle.
///
/// Thread contract: as for a container: const functions from any thread, others need exclusive access.
class OccupancyMap {
 public:
  /// @param side [m]  of a cell.   @param extent [m]  of the window.
  OccupancyMap(double side, double extent);
  /// Takes over a map of any shape, each cell as one scan would have seen it, echoes in the middle. It is not to follow() anything.
  explicit OccupancyMap(const FloorGrid& grid);

  /// Forgets everything and puts the window around `middle`.
  void reset(Vec2 middle);
  /// Moves the window by whole cells if `place` has left its middle half. Cells that leave the window are forgotten.
  void follow(Vec2 place);
  /// Takes over one scan. Parts of beams outside the window do not count.
  void see(std::span<const Beam> scan);
  /// Makes free what the beams of a scan pass through, also where they end without an echo, except where that scan has seen something. A smooth wall at a
  /// grazing angle is forgotten as well: call it only if nothing leads on.
  /// @pre  see() has taken over this scan last.
  void clear_along(std::span<const Beam> scan);
  /// Makes a place as surely occupied as can be, whatever has been seen there. A place outside the window does not count.
  void hold(Vec2 place);
  /// Weakens what is known of each cell by a 16th of the strongest evidence: 16 times after it was seen last, nothing is known of any.
  void fade();
  /// Makes unknown all that lies farther than `distance` [m] from `place`.
  void forget_beyond(Vec2 place, double distance);

  /// Returns all that it knows, for unpack() of another map in a build of the same source.
  [[nodiscard]] std::string packed() const;
  /// Takes over what another map knew.
  /// @return whether that one had as many cells of the same size; otherwise nothing changes.
  [[nodiscard]] bool unpack(std::string_view text);

  [[nodiscard]] const Lattice& lattice() const { return lattice_; }
  /// @pre  lattice().holds(cell), also for free(), known() and point().
  [[nodiscard]] bool occupied(Cell cell) const { return cells_[lattice_.index(cell)].evidence > 0; }
  [[nodiscard]] bool occupied(std::size_t index) const { return cells_[index].evidence > 0; }
  /// Returns whether a scan has seen that nothing is there, and no later one that something is.
  [[nodiscard]] bool free(Cell cell) const { return cells_[lattice_.index(cell)].evidence < 0; }
  [[nodiscard]] bool known(std::size_t index) const { return cells_[index].evidence != 0; }
  /// Returns the mean of the latest echoes within an occupied cell, to within 1/32 of the cell.
  [[nodiscard]] Vec2 point(Cell cell) const;
  /// Calls `visit(point)` for the echoes of occupied cells in the square of half side `reach` [m] around `place`.
  template <typename Visit>
  void for_points_near(Vec2 place, double reach, Visit visit) const {
    const Cell low = lattice_.cell_at(place - Vec2{reach, reach});
    const Cell high = lattice_.cell_at(place + Vec2{reach, reach});
    for (int row = std::max(low.row, 0); row <= std::min(high.row, lattice_.rows - 1); ++row)
      for (int column = std::max(low.column, 0); column <= std::min(high.column, lattice_.columns - 1);
           ++column)
        if (occupied(Cell{column, row})) visit(point({column, row}));
  }

 private:
  struct State {
    std::int8_t evidence = 0;          // above 0: occupied; 0: unknown
    std::array<std::uint8_t, 2> at{};  // mean of the latest echoes, in 1/256 of the cell
    std::uint8_t scan = 0;             // number of the last scan that counted here
  };

  void hit(const Beam& beam);
  void look_through(const Beam& beam);

  Lattice lattice_;
  std::vector<State> cells_;
  std::uint8_t scan_ = 0;
};

}  // namespace orca::nav
