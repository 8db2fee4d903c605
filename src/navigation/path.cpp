// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/path.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/portable_math.hpp"
#include "orca/navigation/floor_rules.hpp"

namespace orca::nav {
namespace {

constexpr double kCostPerCell = 5.0;  // of a step to the cell beside, times the cell's cost

std::vector<double> costs_so_far(const Lattice& lattice, std::span<const std::uint16_t> costs,
                                 const CellWay& way) {
  std::vector<double> sum{0.0};
  for (std::size_t i = 1; i < way.cells.size(); ++i) {
    const double length =
        norm(lattice.middle_of(way.cells[i]) - lattice.middle_of(way.cells[i - 1])) / lattice.side;
    const double both = costs[lattice.index(way.cells[i])] + costs[lattice.index(way.cells[i - 1])];
    sum.push_back(sum.back() + kCostPerCell * length * 0.5 * both);
  }
  return sum;
}

std::vector<Vec2> cut(std::span<const Vec2> line, double spacing) {
  std::vector<Vec2> points{line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2 way = line[i] - line[i - 1];
    const int pieces = std::max(1, static_cast<int>(std::lround(norm(way) / spacing)));
    for (int k = 1; k <= pieces; ++k) points.push_back(line[i - 1] + (static_cast<double>(k) / pieces) * way);
  }
  return points;
}

}  // namespace

Path::Path(std::span<const Vec2> points) {
  for (const Vec2 point : points) {
    if (!points_.empty() && point == points_.back()) continue;
    along_.push_back(points_.empty() ? 0.0 : along_.back() + norm(point - points_.back()));
    points_.push_back(point);
  }
}

// Returns the number of the point at which the piece begins.
std::size_t Path::piece_at(double along) const {
  const auto next = std::upper_bound(along_.begin(), along_.end(), along);
  const auto index = static_cast<std::size_t>(next - along_.begin());
  return std::min(index > 0 ? index - 1 : 0, points_.size() >= 2 ? points_.size() - 2 : 0);
}

Vec2 Path::at(double along) const {
  if (points_.size() == 1) return points_.front();
  const std::size_t i = piece_at(along);
  const double share = std::clamp((along - along_[i]) / (along_[i + 1] - along_[i]), 0.0, 1.0);
  return points_[i] + share * (points_[i + 1] - points_[i]);
}

double Path::heading(double along) const {
  if (points_.size() == 1) return 0.0;
  const std::size_t i = piece_at(along);
  const Vec2 way = points_[i + 1] - points_[i];
  return portable::atan2(way.y, way.x);
}

double Path::nearest(Vec2 point, double from, double to) const {
  double best = from;
  double least = norm(at(from) - point);
  for (std::size_t i = piece_at(from); i + 1 < points_.size() && along_[i] <= to; ++i) {
    const Vec2 way = points_[i + 1] - points_[i];
    const double share = std::clamp(dot(point - points_[i], way) / dot(way, way), 0.0, 1.0);
    const double along = std::clamp(along_[i] + share * (along_[i + 1] - along_[i]), from, to);
    const double off = norm(at(along) - point);
    if (off < least) {
      least = off;
      best = along;
    }
  }
  return best;
}

double cost_of_line(const Lattice& lattice, std::span<const std::uint16_t> costs, Vec2 from, Vec2 to,
                    std::span<const std::uint8_t> forbidden) {
  const std::uint8_t bit = forbidden.empty() ? std::uint8_t{0} : direction_bit(to - from);
  double sum = 0.0;
  int count = 0;
  const bool passable = walk_line(lattice, from, to, [&](Cell cell) {
    if (!lattice.holds(cell) || costs[lattice.index(cell)] == 0) return false;
    if (!forbidden.empty() && (forbidden[lattice.index(cell)] & bit) != 0) return false;
    sum += costs[lattice.index(cell)];
    ++count;
    return true;
  });
  return passable ? kCostPerCell * norm(to - from) / lattice.side * sum / count : kImpassable;
}

std::vector<Vec2> straightened(const Lattice& lattice, std::span<const std::uint16_t> costs,
                               const CellWay& way, std::span<const std::uint8_t> forbidden) {
  const std::vector<double> so_far = costs_so_far(lattice, costs, way);
  std::vector<Vec2> line{lattice.middle_of(way.cells.front())};
  for (std::size_t i = 0; i + 1 < way.cells.size();) {
    std::size_t end = i + 1;
    while (end + 1 < way.cells.size() &&
           cost_of_line(lattice, costs, line.back(), lattice.middle_of(way.cells[end + 1]), forbidden) <=
               so_far[end + 1] - so_far[i])
      ++end;
    line.push_back(lattice.middle_of(way.cells[end]));
    i = end;
  }
  return line;
}

Path rounded(const Lattice& lattice, std::span<const std::uint16_t> costs, std::span<const Vec2> line,
             double spacing, int rounds, std::span<const std::uint8_t> forbidden) {
  std::vector<Vec2> points = cut(line, spacing);
  const auto cost_at = [&](Vec2 point) {
    const Cell cell = lattice.cell_at(point);
    return lattice.holds(cell) ? costs[lattice.index(cell)] : std::uint16_t{0};
  };
  for (int round = 0; round < rounds; ++round)
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const Vec2 moved = 0.5 * points[i] + 0.25 * (points[i - 1] + points[i + 1]);
      const std::uint16_t cost = cost_at(moved);
      if (cost == 0 || cost > std::max(cost_at(points[i]), kPlainCost)) continue;
      if (forbidden.empty() || (cost_of_line(lattice, costs, points[i - 1], moved, forbidden) < kImpassable &&
                                cost_of_line(lattice, costs, moved, points[i + 1], forbidden) < kImpassable))
        points[i] = moved;
    }
  return Path(points);
}

}  // namespace orca::nav
