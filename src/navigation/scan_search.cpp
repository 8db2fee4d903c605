// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"
#include "orca/navigation/distance_transform.hpp"
#include "orca/navigation/scan_match.hpp"

namespace orca::nav {
namespace {

constexpr double kSoft = 0.07;  // [m] by which a point may be off and still count 0.6
constexpr int kReach = 5;       // [cells] beyond which it counts nothing

std::vector<std::uint8_t> field_of(const Lattice& lattice, std::span<const SurfacePoint> points) {
  std::vector<std::uint8_t> hit(lattice.size(), 0);
  for (const SurfacePoint& point : points) hit[lattice.index(lattice.cell_at(point.at))] = 1;
  DistanceTransform transform;
  const std::span<const std::int32_t> squared = transform(hit, lattice.columns, lattice.rows, kReach);
  std::array<std::uint8_t, kReach * kReach + 1> value{};
  for (std::size_t i = 0; i < value.size(); ++i)
    value[i] = static_cast<std::uint8_t>(
        std::lround(ScanSearch::kFull * portable::exp(-static_cast<double>(i) * lattice.side * lattice.side /
                                                      (2.0 * kSoft * kSoft))));
  std::vector<std::uint8_t> field(lattice.size());
  for (std::size_t i = 0; i < field.size(); ++i)
    field[i] = squared[i] <= kReach * kReach ? value[static_cast<std::size_t>(squared[i])] : 0;
  return field;
}

// Returns the greatest of each cell and the one `step` cells on, in both directions.
std::vector<std::uint8_t> widened(const Lattice& lattice, const std::vector<std::uint8_t>& field, int step) {
  std::vector<std::uint8_t> wide(field);
  for (int row = 0; row < lattice.rows; ++row)
    for (int column = 0; column + step < lattice.columns; ++column) {
      std::uint8_t& here = wide[lattice.index({column, row})];
      here = std::max(here, field[lattice.index({column + step, row})]);
    }
  std::vector<std::uint8_t> result(wide);
  for (int row = 0; row + step < lattice.rows; ++row)
    for (int column = 0; column < lattice.columns; ++column) {
      std::uint8_t& here = result[lattice.index({column, row})];
      here = std::max(here, wide[lattice.index({column, row + step})]);
    }
  return result;
}

}  // namespace

// A field around the points that is wide enough for any block that reaches into it from the left and from below.
ScanSearch::ScanSearch(std::span<const SurfacePoint> points) {
  if (points.empty()) return;
  Vec2 low = points.front().at;
  Vec2 high = low;
  for (const SurfacePoint& point : points) {
    low = {std::min(low.x, point.at.x), std::min(low.y, point.at.y)};
    high = {std::max(high.x, point.at.x), std::max(high.y, point.at.y)};
  }
  const int before = kReach + (1 << (kLevels - 1));
  lattice_.side = kSide;
  lattice_.corner = low - Vec2{before * kSide, before * kSide};
  lattice_.columns = static_cast<int>((high.x - low.x) / kSide) + before + kReach + 2;
  lattice_.rows = static_cast<int>((high.y - low.y) / kSide) + before + kReach + 2;
  levels_[0] = field_of(lattice_, points);
  for (int level = 1; level < kLevels; ++level)
    levels_[static_cast<std::size_t>(level)] =
        widened(lattice_, levels_[static_cast<std::size_t>(level - 1)], 1 << (level - 1));
}

/// A search for one scan: its points turned by each angle, as cells, and the blocks of places that are left.
struct ScanSearch::Search {
  struct Block {
    int turn, x, y;  // of the cell of least x and y
    int sum;         // of the greatest values that any place of the block can have
  };

  const ScanSearch& map;
  const SearchWindow& window;
  int steps;     // [cells] to each side
  int best_sum;  // so far
  Block best{-1, 0, 0, 0};
  std::vector<std::vector<Cell>> turned{};

  [[nodiscard]] int sum_of(int turn, int x, int y, int level) const {
    return map.bound(turned[static_cast<std::size_t>(turn)], {x, y}, level);
  }

  void look_into(const Block& block, int level) {
    if (block.sum <= best_sum) return;
    if (level == 0) {
      best = block;
      best_sum = block.sum;
      return;
    }
    const int half = 1 << (level - 1);
    std::array<Block, 4> parts;
    std::size_t count = 0;
    for (const int dx : {0, half})
      for (const int dy : {0, half}) {
        if (block.x + dx > steps || block.y + dy > steps) continue;
        parts[count++] = {block.turn, block.x + dx, block.y + dy,
                          sum_of(block.turn, block.x + dx, block.y + dy, level - 1)};
      }
    const std::span<Block> some(parts.data(), count);
    std::ranges::stable_sort(some, std::ranges::greater(), &Block::sum);
    for (const Block& part : some) look_into(part, level - 1);
  }
};

std::optional<Found> ScanSearch::best(std::span<const SurfacePoint> scan, const SearchWindow& window,
                                      double least_score) const {
  if (levels_[0].empty() || scan.empty()) return std::nullopt;
  double farthest = kSide;
  for (const SurfacePoint& point : scan) farthest = std::max(farthest, norm(point.at));
  const double pitch = kSide / farthest;
  const int turns = static_cast<int>(std::ceil(std::min(window.turn, std::numbers::pi) / pitch));
  Search search{*this, window, static_cast<int>(std::ceil(window.way / kSide)),
                static_cast<int>(least_score * kFull * static_cast<double>(scan.size()))};
  for (int i = -turns; i <= turns; ++i) {
    const Vec2 ahead = direction(window.middle.yaw + i * pitch);
    std::vector<Cell>& cells = search.turned.emplace_back();
    cells.reserve(scan.size());
    for (const SurfacePoint& point : scan)
      cells.push_back(lattice_.cell_at(window.middle.position() + rotated(point.at, ahead)));
  }
  int level = 0;
  while (level + 1 < kLevels && (2 << level) <= search.steps) ++level;
  std::vector<Search::Block> blocks;
  for (int turn = 0; turn <= 2 * turns; ++turn)
    for (int x = -search.steps; x <= search.steps; x += 1 << level)
      for (int y = -search.steps; y <= search.steps; y += 1 << level)
        blocks.push_back({turn, x, y, search.sum_of(turn, x, y, level)});
  std::ranges::stable_sort(blocks, std::ranges::greater(), &Search::Block::sum);
  for (const Search::Block& block : blocks) search.look_into(block, level);
  if (search.best.turn < 0) return std::nullopt;
  const Pose2 X_MR{window.middle.x + search.best.x * kSide, window.middle.y + search.best.y * kSide,
                   wrapped(window.middle.yaw + (search.best.turn - turns) * pitch)};
  return Found{X_MR, search.best_sum / (kFull * static_cast<double>(scan.size()))};
}

double ScanSearch::score(std::span<const SurfacePoint> scan, const Pose2& X_MR) const {
  if (levels_[0].empty() || scan.empty()) return 0.0;
  double sum = 0.0;
  for (const SurfacePoint& point : scan) {
    const Cell at = lattice_.cell_at(X_MR * point.at);
    if (lattice_.holds(at)) sum += levels_[0][lattice_.index(at)];
  }
  return sum / (kFull * static_cast<double>(scan.size()));
}

}  // namespace orca::nav
