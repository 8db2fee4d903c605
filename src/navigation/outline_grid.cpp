// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/outline_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace orca::nav {

void OutlineGrid::look_at(const OccupancyMap& map, const Footprint& footprint, double margin) {
  lattice_ = map.lattice();
  cells_per_metre_ = 1.0 / lattice_.side;
  footprint_ = {0.0, 0.0, footprint.outer_radius() + margin};
  if (!footprint.is_circle()) {
    footprint_.half_length = footprint.half_length + margin;
    footprint_.half_width = footprint.half_width + margin;
  }
  obstacles_.resize(lattice_.size());
  so_far_.resize(lattice_.size() + static_cast<std::size_t>(lattice_.rows));
  std::size_t at = 0;
  for (int row = 0; row < lattice_.rows; ++row) {
    std::int32_t count = 0;
    for (int column = 0; column < lattice_.columns; ++column) {
      const std::size_t index = lattice_.index({column, row});
      obstacles_[index] = map.occupied(index) ? 1 : 0;
      so_far_[at++] = count;
      count += obstacles_[index];
    }
    so_far_[at++] = count;
  }
  // Both the robot and the nearest point of an occupied cell may be half a diagonal from the middle of their cells.
  const double reach = footprint_.outer_radius() / lattice_.side + std::numbers::sqrt2;
  const auto squared =
      transform_(obstacles_, lattice_.columns, lattice_.rows, static_cast<int>(std::ceil(reach)) + 1);
  near_.resize(lattice_.size());
  for (std::size_t i = 0; i < near_.size(); ++i) near_[i] = squared[i] <= reach * reach ? 1 : 0;
}

int OutlineGrid::occupied_in(int row, const Stretch& stretch) const {
  const double last = lattice_.columns;
  const double low = (stretch.low - lattice_.corner.x) * cells_per_metre_;
  const double high = (stretch.high - lattice_.corner.x) * cells_per_metre_;
  if (high < 0.0 || low >= last || high < low) return 0;
  const auto from = static_cast<std::size_t>(std::max(0.0, low));
  const auto to = static_cast<std::size_t>(std::min(last, high + 1.0));
  const std::size_t begin = static_cast<std::size_t>(row) * (static_cast<std::size_t>(lattice_.columns) + 1);
  return so_far_[begin + to] - so_far_[begin + from];
}

// A convex outline within a row covers one stretch: from the leftmost to the rightmost point of its edges there.
OutlineGrid::Stretch OutlineGrid::stretch(std::span<const Vec2, 4> corners, double low, double high) const {
  Stretch stretch{INFINITY, -INFINITY};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 a = corners[i];
    const Vec2 b = corners[(i + 1) % corners.size()];
    if (std::max(a.y, b.y) < low || std::min(a.y, b.y) > high) continue;
    const double slope = a.y == b.y ? 0.0 : (b.x - a.x) / (b.y - a.y);
    const double one = a.x + slope * (std::clamp(a.y, low, high) - a.y);
    const double other = a.y == b.y ? b.x : a.x + slope * (std::clamp(b.y, low, high) - a.y);
    stretch.low = std::min({stretch.low, one, other});
    stretch.high = std::max({stretch.high, one, other});
  }
  return stretch;
}

OutlineGrid::Stretch OutlineGrid::stretch_of_circle(Vec2 middle, double low, double high) const {
  const double off = middle.y - std::clamp(middle.y, low, high);
  const double half = std::sqrt(std::max(0.0, footprint_.radius * footprint_.radius - off * off));
  return {middle.x - half, middle.x + half};
}

int OutlineGrid::touched_by_circle(Vec2 middle) const {
  int count = 0;
  const Cell low = lattice_.cell_at(middle - Vec2{footprint_.radius, footprint_.radius});
  const Cell high = lattice_.cell_at(middle + Vec2{footprint_.radius, footprint_.radius});
  for (int row = std::max(low.row, 0); row <= std::min(high.row, lattice_.rows - 1); ++row) {
    const double y = lattice_.corner.y + row * lattice_.side;
    count += occupied_in(row, stretch_of_circle(middle, y, y + lattice_.side));
  }
  return count;
}

int OutlineGrid::touched(const Pose2& pose) const {
  const Cell cell = lattice_.cell_at(pose.position());
  if (lattice_.holds(cell) && near_[lattice_.index(cell)] == 0) return 0;
  if (footprint_.is_circle()) return touched_by_circle(pose.position());
  const Vec2 axis = direction(pose.yaw);
  const Vec2 ahead = footprint_.half_length * axis;
  const Vec2 left = footprint_.half_width * Vec2{-axis.y, axis.x};
  const Vec2 middle = pose.position();
  const std::array<Vec2, 4> corners{middle + ahead + left, middle - ahead + left, middle - ahead - left,
                                    middle + ahead - left};
  const auto [lowest, highest] = std::ranges::minmax(corners, {}, &Vec2::y);
  const double low = std::max(lowest.y, middle.y - footprint_.radius);
  const double high = std::min(highest.y, middle.y + footprint_.radius);
  const int last = std::min(lattice_.cell_at({middle.x, high}).row, lattice_.rows - 1);
  int count = 0;
  for (int row = std::max(lattice_.cell_at({middle.x, low}).row, 0); row <= last; ++row) {
    const double y = lattice_.corner.y + row * lattice_.side;
    const Stretch within = stretch(corners, y, y + lattice_.side);
    const Stretch round = stretch_of_circle(middle, y, y + lattice_.side);
    count += occupied_in(row, {std::max(within.low, round.low), std::min(within.high, round.high)});
  }
  return count;
}

bool OutlineGrid::may_drive(Pose2 pose, std::span<const WayPiece> way, double step) const {
  int before = touched(pose);
  for (const WayPiece& piece : way) {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(piece.length) / step)));
    const double length = piece.length / steps;
    for (int i = 0; i < steps; ++i) {
      pose = driven(pose, piece, length);
      const int now = touched(pose);
      if (now > before || !lattice_.holds(lattice_.cell_at(pose.position()))) return false;
      before = now;
    }
  }
  return true;
}

}  // namespace orca::nav
