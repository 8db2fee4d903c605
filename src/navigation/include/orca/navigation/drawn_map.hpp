// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "orca/navigation/lattice.hpp"
#include "orca/navigation/slam.hpp"

namespace orca::nav {

/// A rectangle of a map's cells, row by row.
struct MapPart {
  Lattice lattice;
  std::vector<std::uint8_t> cells;  ///< 0 free, 100 occupied, 255 not known.
};

/// The occupancy of a map that grows and bends: what the nodes of a Slam have seen, drawn where they lie now.
///
/// Each node counts at most once in a cell: as an echo if one of its points lies there, else as a look through if a line from its sensor to one of
/// its points does. A cell is occupied if more than a third of the nodes that count there had an echo. So cells depend on where
/// the nodes are drawn alone, not on the order in which they came or moved. Only lines with an echo at their end say that something is free.
///
/// Nodes that have moved since they were drawn are taken out and drawn again; those that have moved by less than half a cell, and turned by
/// less than 0.005 rad, stay. An echo 20 m away may then be drawn 0.13 m from where it is known to be now, one 5 m away 0.05 m.
///
/// Thread contract: as for a container.
/// @source  counting, as in reflection maps: Hähnel, Schulz and Burgard, "Map building with mobile robots in populated environments", IROS 2002.
class DrawnMap {
 public:
  /// @param side [m]  of a cell.
  explicit DrawnMap(double side) : lattice_{{}, side, 0, 0} {}

  /// Draws at most `most` of the nodes that are new or have moved, the newest first.
  /// @param nodes  of one Slam; each call has those of the call before, and new ones behind them.
  /// @return whether all are drawn where they lie now.
  bool draw(std::span<const SlamNode> nodes, std::size_t most);

  /// Returns the smallest rectangle of whole tiles of 64 x 64 cells that holds all cells that have changed since the last call.
  [[nodiscard]] std::optional<MapPart> news();

  /// Returns all tiles; cells between them are not known.
  [[nodiscard]] MapPart whole() const;

 private:
  static constexpr int kTile = 64;  // [cells] side of a tile
  static constexpr std::size_t kCells = std::size_t{kTile} * kTile;

  struct Count {
    std::uint32_t echoes = 0;
    std::uint32_t looks = 0;
    std::uint32_t visit = 0;  // that counted here last
  };
  struct Tile {
    std::array<Count, kCells> counts{};
    std::array<std::uint8_t, kCells> said{};  // of the cells by news()
    bool touched = true;
  };
  struct Place {
    int row;
    int column;
    friend auto operator<=>(const Place&, const Place&) = default;
  };
  struct Extent {
    Place low, high;
    void add(Place place);
  };
  using Tiles = std::map<Place, Tile>;

  static std::uint8_t cell_of(const Count& count);
  static bool say(Tile& tile);
  [[nodiscard]] bool lies_right(const SlamNode& node, std::size_t index) const;
  // Counts a node at a pose, or takes it out again.
  void count(const SlamNode& node, const Pose2& X_MR, bool out);
  Count& count_of(Cell cell);
  [[nodiscard]] MapPart part(const Extent& extent) const;

  Lattice lattice_;  // without an end
  Tiles tiles_;
  std::vector<Pose2> drawn_at_;
  std::vector<bool> drawn_;
  std::uint32_t visit_ = 0;
  std::pair<Place, Tile*> latest_{{}, nullptr};
};

}  // namespace orca::nav
