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

/// The manner in which a grid is searched.
struct SearchRules {
  std::uint32_t straight =
      5;  ///< [1] cost of a step, as a multiple of the mean cost of the cells that it leads from and to.
  std::uint32_t diagonal = 7;  ///< [1] likewise.
  /// Among equally cheap ways it takes the one that a queue in the order of cost and cell number finds first. Otherwise cells of about the same
  /// cost are taken as they come, and between nine cells of the same cost no second way is followed where one as cheap is known.
  bool ordered = true;
};
/// Lengths to within 2e-6, in any order: the cheapest way by them is the shortest one, found three times as fast.
inline constexpr SearchRules kShortest{408, 577, false};

/// The cheapest way through a grid by A*, with buffers that are kept from call to call.
///
/// A diagonal step cuts no corner: both cells beside it must be passable. Cells wait in buckets of about equal cost of the whole
/// way. The result depends on nothing but the arguments.
///
/// Thread contract: one thread at a time.
/// @source  Hart, Nilsson and Raphael, "A Formal Basis for the Heuristic Determination of Minimum Cost Paths", IEEE Trans. on
///          Systems Science and Cybernetics 4, 1968; octile distance as the estimate. Buckets: Dial, "Algorithm 360: Shortest-Path
///          Forest with Topological Ordering", Communications of the ACM 12, 1969. Ways that are not followed: the neighbours of Harabor and Grastien,
///          "Online Graph Pruning for Pathfinding on Grid Maps", AAAI 2011, without the jumps; here wherever nine cells cost the same.
class GridSearch {
 public:
  explicit GridSearch(SearchRules rules = {});

  /// Finds the cheapest way. If the goal cannot be reached, it leads to the cell that can be reached whose straight distance to
  /// the goal is least, and of these, if ordered, to the cheapest.
  /// @param costs  of each cell, at least kPlainCost; 0: not passable. The start may be impassable.
  /// @pre  the lattice holds start and goal; costs.size() = lattice.size() < 2^24; costs at most 2000; the way costs less than 2^32.
  /// @param forbidden  of each cell the directions in which no step leads from or to it, as bits, see FloorRules; none: all may.
  [[nodiscard]] CellWay operator()(const Lattice& lattice, std::span<const std::uint16_t> costs, Cell start,
                                   Cell goal, std::span<const std::uint8_t> forbidden = {});

  /// Finds what the cheapest way from each cell to `goal` costs, in the order of these costs, until it knows that of `start` and of all whose
  /// way costs at most `beyond` more.
  /// @pre  as for a search. Ways cost as much in both directions, if all cells are passable.
  void flood(const Lattice& lattice, std::span<const std::uint16_t> costs, Cell goal, Cell start,
             std::uint32_t beyond);
  /// Returns what the last flood() has found for a cell; for one that it has not come to, a cost that its way reaches at least.
  /// @return UINT32_MAX if no way leads to the goal.
  [[nodiscard]] std::uint32_t cost_from(std::size_t index) const {
    if (is_found(index)) return nodes_[index].cost;
    return waiting_ > 0 ? static_cast<std::uint32_t>(turn_ << shift_) : UINT32_MAX;
  }

 private:
  static constexpr int kRoundShift = 5;
  struct Node {
    std::uint32_t cost = 0;
    std::uint32_t mark =
        0;  // round that found it, whether it is closed, number of the direction that led here
  };
  // One search, as long as it lasts.
  struct Task {
    const Lattice& lattice;
    std::span<const std::uint16_t> costs;
    Cell goal;
    std::span<const std::uint8_t> forbidden{};
    bool floods = false;  // to everywhere
  };

  void begin(std::size_t cells);
  void open(const Task& task, Cell cell, std::uint32_t cost, std::uint32_t from);
  [[nodiscard]] std::optional<std::size_t> take();
  void expand(const Task& task, Cell cell, std::size_t index);
  [[nodiscard]] std::uint32_t least_cost(Cell cell, Cell goal) const;
  [[nodiscard]] bool is_found(std::size_t index) const { return nodes_[index].mark >> kRoundShift == round_; }
  [[nodiscard]] CellWay way_to(const Lattice& lattice, std::size_t end) const;

  SearchRules rules_;
  int shift_;  // a bucket is 2^shift_ wide
  std::vector<Node> nodes_;
  std::vector<std::vector<std::uint64_t>> buckets_;  // estimated cost of the whole way, then the cell
  std::uint64_t turn_ = 0;                           // of the bucket from which cells are taken
  std::size_t waiting_ = 0;                          // cells in all buckets
  std::uint32_t round_ = 0;
};

}  // namespace orca::nav
