// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "orca/navigation/lattice.hpp"

namespace orca::nav {

/// The unit of a cell's cost: a cell of this cost costs as much as its length.
inline constexpr std::uint16_t kPlainCost = 16;

/// A way through the cells of a lattice.
struct CellWay {
  std::vector<Cell> cells;  ///< from start to end, each beside or diagonally beside the one before.
  std::uint32_t cost = 0;   ///< of all steps, see GridSearch.
  bool complete = false;    ///< whether it ends in the goal, not only as near to it as the cells allow.
};

/// The cheapest way through a grid by A*, with buffers that are kept from call to call.
///
/// A step to a cell beside costs 5 times the mean cost of both cells, a diagonal one 7 times. A diagonal step cuts no corner:
/// both cells beside it must be passable. Ties are broken by cell number, so the result depends on nothing else.
///
/// Thread contract: one thread at a time.
/// @source  Hart, Nilsson and Raphael, "A Formal Basis for the Heuristic Determination of Minimum Cost Paths", IEEE Trans. on
///          Systems Science and Cybernetics 4, 1968; octile distance as the estimate.
class GridSearch {
 public:
  /// Finds the cheapest way. If the goal cannot be reached, it leads to the cell that can be reached whose straight distance to
  /// the goal is least, and of these to the cheapest.
  /// @param costs  of each cell, at least kPlainCost; 0: not passable. The start may be impassable.
  /// @pre  the lattice holds start and goal; costs.size() = lattice.size() < 2^24; costs at most 2000.
  [[nodiscard]] CellWay operator()(const Lattice& lattice, std::span<const std::uint16_t> costs, Cell start,
                                   Cell goal);

 private:
  struct Node {
    std::uint32_t cost = 0;
    std::uint32_t round = 0;  // that found it; others have not been found
    std::int8_t from = 0;     // number of the direction that led here
    bool closed = false;
  };

  void open(std::size_t index, std::uint32_t cost, std::int8_t from, std::uint32_t estimate);
  void expand(const Lattice& lattice, std::span<const std::uint16_t> costs, std::size_t index, Cell goal);
  [[nodiscard]] CellWay way_to(const Lattice& lattice, std::size_t end) const;

  std::vector<Node> nodes_;
  std::vector<std::uint64_t> heap_;  // estimated cost of the whole way, then the cell
  std::uint32_t round_ = 0;
};

}  // namespace orca::nav
