// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"
#include "orca/navigation/known_map.hpp"

namespace orca::nav {
namespace {

constexpr std::ptrdiff_t kNeighbours = 15;  // on each side
constexpr double kFlat = 0.25;              // Largest spread across a line, as a share of that along it.

/// Sums over points, of which the main direction is found.
struct Spread {
  double count = 0.0;
  Vec2 sum;
  double xx = 0.0, xy = 0.0, yy = 0.0;

  void add(Vec2 p) {
    count += 1.0;
    sum = sum + p;
    xx += p.x * p.x;
    xy += p.x * p.y;
    yy += p.y * p.y;
  }
};

// Returns the normal of the line through the points, towards neither side; (0, 0) if they lie on none.
Vec2 normal_of(const Spread& s) {
  if (s.count < 3.0) return {};
  const double xx = s.xx - s.sum.x * s.sum.x / s.count;
  const double xy = s.xy - s.sum.x * s.sum.y / s.count;
  const double yy = s.yy - s.sum.y * s.sum.y / s.count;
  const double middle = (xx + yy) / 2.0;
  const double apart = std::sqrt((xx - yy) * (xx - yy) / 4.0 + xy * xy);
  if (!(middle - apart <= kFlat * kFlat * (middle + apart)) || middle + apart <= 0.0) return {};
  return direction(portable::atan2(2.0 * xy, xx - yy) / 2.0 + std::numbers::pi / 2.0);
}

constexpr std::array<Cell, 4> kSides{Cell{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

Cell beside(Cell cell, Cell step) { return {cell.column + step.column, cell.row + step.row}; }

// Returns for each cell towards which of the four sides it shows a surface, as bits.
std::vector<std::uint8_t> faces_of(const FloorGrid& grid) {
  std::vector<std::uint8_t> faces(grid.cells.size(), 0);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Cell cell = grid.lattice.cell_of(i);
    if (!grid.occupied(cell)) continue;
    for (std::size_t side = 0; side < kSides.size(); ++side)
      if (grid.free(beside(cell, kSides[side]))) faces[i] |= static_cast<std::uint8_t>(1U << side);
  }
  return faces;
}

/// The neighbours of a cell that face the same side.
struct Face {
  const FloorGrid& grid;
  std::span<const std::uint8_t> faces;
  int reach;  // [cells]

  // Walks along the surface in both directions, as far as it goes on.
  [[nodiscard]] SurfacePoint at(Cell cell, std::size_t side) const {
    const Cell out = kSides[side];
    const Cell along{-out.row, out.column};
    Spread spread;
    spread.add({});
    for (const int way : {1, -1})
      for (int step = 1, off = 0; step <= reach; ++step) {
        const Cell next = beside(
            cell, {way * step * along.column + off * out.column, way * step * along.row + off * out.row});
        const int found = follow(next, side);
        if (found == kNone) break;
        off += found;
        spread.add(grid.lattice.side * Vec2{static_cast<double>(way * step * along.column + off * out.column),
                                            static_cast<double>(way * step * along.row + off * out.row)});
      }
    Vec2 normal = normal_of(spread);
    const Vec2 middle = grid.lattice.middle_of(cell);
    if (normal == Vec2{}) return {middle, {}};
    if (dot(normal, {static_cast<double>(out.column), static_cast<double>(out.row)}) < 0.0)
      normal = -1.0 * normal;
    return {middle + dot(normal, 1.0 / spread.count * spread.sum) * normal, normal};
  }

 private:
  static constexpr int kNone = 9;

  // Returns by how many cells towards that side the surface has moved.
  [[nodiscard]] int follow(Cell cell, std::size_t side) const {
    for (const int off : {0, 1, -1}) {
      const Cell there = beside(cell, {off * kSides[side].column, off * kSides[side].row});
      if (grid.lattice.holds(there) && (faces[grid.lattice.index(there)] & (1U << side)) != 0) return off;
    }
    return kNone;
  }
};

}  // namespace

std::vector<SurfacePoint> surface_of(const FloorGrid& grid) {
  constexpr double kAlong = 0.25;  // [m]
  constexpr double kFacing = 0.6;  // cosine; at 45 degrees two sides show the same surface
  const std::vector<std::uint8_t> faces = faces_of(grid);
  const Face face{grid, faces, std::max(3, static_cast<int>(kAlong / grid.lattice.side))};
  std::vector<SurfacePoint> result;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    bool shown = faces[i] == 0;
    const Cell cell = grid.lattice.cell_of(i);
    for (std::size_t side = 0; side < kSides.size(); ++side) {
      if ((faces[i] & (1U << side)) == 0) continue;
      const SurfacePoint point = face.at(cell, side);
      const Vec2 out{static_cast<double>(kSides[side].column), static_cast<double>(kSides[side].row)};
      if (dot(point.normal, out) < kFacing) continue;
      result.push_back(point);
      shown = true;
    }
    if (!shown) result.push_back({grid.lattice.middle_of(cell), {}});
  }
  return result;
}

std::vector<SurfacePoint> surface_of(std::span<const Vec2> points, Vec2 sensor, double reach) {
  std::vector<SurfacePoint> result;
  result.reserve(points.size());
  const auto count = static_cast<std::ptrdiff_t>(points.size());
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const Vec2 here = points[static_cast<std::size_t>(i)];
    Spread spread;
    for (std::ptrdiff_t j = std::max<std::ptrdiff_t>(0, i - kNeighbours);
         j <= std::min(count - 1, i + kNeighbours); ++j) {
      const Vec2 off = points[static_cast<std::size_t>(j)] - here;
      if (norm(off) <= reach) spread.add(off);
    }
    const Vec2 normal = normal_of(spread);
    result.push_back({here, dot(normal, sensor - here) < 0.0 ? -1.0 * normal : normal});
  }
  return result;
}

std::vector<SurfacePoint> thinned(std::span<const SurfacePoint> points, double apart, std::size_t most) {
  std::vector<SurfacePoint> some;
  for (const SurfacePoint& point : points)
    if (some.empty() || norm(point.at - some.back().at) >= apart) some.push_back(point);
  if (some.size() <= most) return some;
  std::vector<SurfacePoint> fewer;
  for (std::size_t i = 0; i < most; ++i) fewer.push_back(some[i * some.size() / most]);
  return fewer;
}

void SurfaceMap::add(std::span<const SurfacePoint> scan, const Pose2& X_MR) {
  for (const SurfacePoint& point : scan)
    points_.push_back({X_MR * point.at, rotated(point.normal, X_MR.yaw)});
}

void SurfaceMap::prepare() {
  if (points_.empty()) return;
  Vec2 low = points_.front().at;
  Vec2 high = low;
  for (const SurfacePoint& point : points_) {
    low = {std::min(low.x, point.at.x), std::min(low.y, point.at.y)};
    high = {std::max(high.x, point.at.x), std::max(high.y, point.at.y)};
  }
  lattice_.corner = low;
  lattice_.columns = static_cast<int>((high.x - low.x) / lattice_.side) + 1;
  lattice_.rows = static_cast<int>((high.y - low.y) / lattice_.side) + 1;
  const auto cell = [&](const SurfacePoint& point) { return lattice_.index(lattice_.cell_at(point.at)); };
  begin_.assign(lattice_.size() + 1, 0);
  for (const SurfacePoint& point : points_) ++begin_[cell(point) + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  std::vector<SurfacePoint> sorted(points_.size());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  for (const SurfacePoint& point : points_) sorted[next[cell(point)]++] = point;
  points_ = std::move(sorted);
}

std::span<const SurfacePoint> SurfaceMap::in_row(int row, int first, int last) const {
  const std::uint32_t begin = begin_[lattice_.index({first, row})];
  return std::span(points_).subspan(begin, begin_[lattice_.index({last, row}) + 1] - begin);
}

const SurfacePoint* SurfaceMap::nearest(Vec2 place, double reach) const {
  constexpr double kRounding = 1e-9;  // [m]
  const auto squared_to = [&](const SurfacePoint& point) {
    const Vec2 off = point.at - place;
    return dot(off, off);
  };
  double least = reach * reach;
  // The own cell is looked at first: it mostly holds a point that is so near that few other cells are left.
  if (const Cell own = lattice_.cell_at(place); lattice_.holds(own))
    for (const SurfacePoint& point : in_row(own.row, own.column, own.column))
      least = std::min(least, squared_to(point));
  const double around = std::min(reach, std::sqrt(least) + kRounding);
  const Cell low = lattice_.cell_at(place - Vec2{around, around});
  const Cell high = lattice_.cell_at(place + Vec2{around, around});
  const int first = std::max(low.column, 0);
  const int last = std::min(high.column, lattice_.columns - 1);
  const SurfacePoint* best = nullptr;
  if (first > last) return best;
  for (int row = std::max(low.row, 0); row <= std::min(high.row, lattice_.rows - 1); ++row)
    for (const SurfacePoint& point : in_row(row, first, last)) {
      const double squared = squared_to(point);
      if (squared > least) continue;
      least = squared;
      best = &point;
    }
  return best;
}

}  // namespace orca::nav
