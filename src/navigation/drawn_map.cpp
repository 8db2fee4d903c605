// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/drawn_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orca::nav {
namespace {

constexpr std::uint8_t kFree = 0;
constexpr std::uint8_t kOccupied = 100;
constexpr std::uint8_t kUnknown = 255;
constexpr std::uint32_t kLooksPerEcho = 2;  // that weigh as much as one echo
constexpr double kTurned = 0.005;           // [rad]

int tile_of(int cell, int tile) { return cell >= 0 ? cell / tile : -((tile - 1 - cell) / tile); }

}  // namespace

bool DrawnMap::lies_right(const SlamNode& node, std::size_t index) const {
  const Pose2& there = drawn_at_[index];
  return drawn_[index] && norm(node.X_MR.position() - there.position()) < lattice_.side / 2.0 &&
         std::fabs(wrapped(node.X_MR.yaw - there.yaw)) < kTurned;
}

bool DrawnMap::draw(std::span<const SlamNode> nodes, std::size_t most) {
  drawn_.resize(nodes.size());
  drawn_at_.resize(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (lies_right(nodes[i], i)) continue;
    if (most-- == 0) return false;
    if (drawn_[i]) count(nodes[i], drawn_at_[i], true);
    count(nodes[i], nodes[i].X_MR, false);
    drawn_[i] = true;
    drawn_at_[i] = nodes[i].X_MR;
  }
  return true;
}

// In the same order each time, so that what is taken out is what was counted.
void DrawnMap::count(const SlamNode& node, const Pose2& X_MR, bool out) {
  const std::uint32_t one = out ? ~std::uint32_t{0} : 1;  // -1, as unsigned numbers wrap around
  ++visit_;
  const auto visits = [&](Count& count) { return std::exchange(count.visit, visit_) != visit_; };
  for (const SurfacePoint& point : node.scan) {
    Count& there = count_of(lattice_.cell_at(X_MR * point.at));
    if (visits(there)) there.echoes += one;
  }
  const Vec2 sensor = X_MR * node.sensor;
  for (const SurfacePoint& point : node.scan)
    walk_line(lattice_, sensor, X_MR * point.at, [&](Cell cell) {
      Count& there = count_of(cell);
      if (visits(there)) there.looks += one;
      return true;
    });
}

DrawnMap::Count& DrawnMap::count_of(Cell cell) {
  const Place place{tile_of(cell.row, kTile), tile_of(cell.column, kTile)};
  if (latest_.second == nullptr || latest_.first != place) {
    const auto [tile, is_new] = tiles_.try_emplace(place);
    if (is_new) tile->second.said.fill(kUnknown);
    tile->second.touched = true;
    latest_ = {place, &tile->second};
  }
  const int row = cell.row - place.row * kTile;
  const int column = cell.column - place.column * kTile;
  return latest_.second->counts[static_cast<std::size_t>(row * kTile + column)];
}

std::uint8_t DrawnMap::cell_of(const Count& count) {
  if (count.echoes + count.looks == 0) return kUnknown;
  return kLooksPerEcho * count.echoes > count.looks ? kOccupied : kFree;
}

// Brings what is said of a tile up to date; returns whether it differs from before.
bool DrawnMap::say(Tile& tile) {
  if (!std::exchange(tile.touched, false)) return false;
  bool differs = false;
  for (std::size_t i = 0; i < kCells; ++i) {
    const std::uint8_t now = cell_of(tile.counts[i]);
    differs |= std::exchange(tile.said[i], now) != now;
  }
  return differs;
}

void DrawnMap::Extent::add(Place place) {
  low = {std::min(low.row, place.row), std::min(low.column, place.column)};
  high = {std::max(high.row, place.row), std::max(high.column, place.column)};
}

std::optional<MapPart> DrawnMap::news() {
  std::optional<Extent> changed;
  for (auto& [place, tile] : tiles_) {
    if (!say(tile)) continue;
    if (!changed) changed = Extent{place, place};
    changed->add(place);
  }
  latest_.second = nullptr;  // so that it is touched again
  if (!changed) return std::nullopt;
  return part(*changed);
}

MapPart DrawnMap::whole() const {
  const Place first = tiles_.empty() ? Place{} : tiles_.begin()->first;
  Extent extent{first, first};
  for (const auto& [place, tile] : tiles_) extent.add(place);
  return part(extent);
}

MapPart DrawnMap::part(const Extent& extent) const {
  const auto& [low, high] = extent;
  const int columns = (high.column - low.column + 1) * kTile;
  const int rows = (high.row - low.row + 1) * kTile;
  const Vec2 corner = lattice_.side * Vec2{double(low.column * kTile), double(low.row * kTile)};
  MapPart part{{corner, lattice_.side, columns, rows}, {}};
  part.cells.assign(part.lattice.size(), kUnknown);
  for (const auto& [place, tile] : tiles_) {
    if (place.row < low.row || place.row > high.row || place.column < low.column ||
        place.column > high.column)
      continue;
    const Cell begin{(place.column - low.column) * kTile, (place.row - low.row) * kTile};
    for (int row = 0; row < kTile; ++row)
      std::transform(tile.counts.begin() + row * kTile, tile.counts.begin() + (row + 1) * kTile,
                     part.cells.begin() +
                         static_cast<std::ptrdiff_t>(part.lattice.index({begin.column, begin.row + row})),
                     cell_of);
  }
  return part;
}

}  // namespace orca::nav
