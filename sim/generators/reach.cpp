// SPDX-License-Identifier: LGPL-3.0-or-later
#include "reach.hpp"

#include <algorithm>
#include <cmath>

namespace orca::sim::detail {
namespace {

// Returns the same as distance(), but without making a list of a box's edges for each point.
double distance_to(const Shape& shape, Vec2 p) {
  const auto* box = std::get_if<Box>(&shape);
  if (box == nullptr) return distance(shape, p);
  const Vec2 own = rotated(p - box->pose.position(), -box->pose.yaw);
  return norm({std::max(0.0, std::fabs(own.x) - box->half.x), std::max(0.0, std::fabs(own.y) - box->half.y)});
}

int nearest(double v) { return static_cast<int>(std::lround(v / Reach::kPitch)); }

}  // namespace

// Returns a lattice that leaves a rim of one pitch around everything.
Reach::Lattice Reach::lattice_of(const WorldModel& world) {
  const Bounds b = world.bounds();
  if (b.empty()) return {0, 0, 1, 1};
  const int left = nearest(b.low.x) - 1;
  const int bottom = nearest(b.low.y) - 1;
  return {left, bottom, nearest(b.high.x) + 2 - left, nearest(b.high.y) + 2 - bottom};
}

bool Reach::fits(const WorldModel& world) {
  const Lattice l = lattice_of(world);
  return static_cast<std::size_t>(l.columns) <= kMostPoints / static_cast<std::size_t>(l.rows);
}

Reach::Reach(const WorldModel& world, Vec2 from, double radius)
    : lattice_(lattice_of(world)),
      points_(static_cast<std::size_t>(lattice_.columns) * static_cast<std::size_t>(lattice_.rows)) {
  for (const Obstacle& obstacle : world.obstacles) block(obstacle, radius + 0.5 * kPitch);
  if (holds(from)) flood(index(from));
}

void Reach::block(const Obstacle& obstacle, double radius) {
  const Bounds b = bounds_of(obstacle.shape);
  const int reach = static_cast<int>(std::ceil(radius / kPitch)) + 1;
  const int right = std::min(nearest(b.high.x) + reach, lattice_.left + lattice_.columns - 1);
  const int top = std::min(nearest(b.high.y) + reach, lattice_.bottom + lattice_.rows - 1);
  for (int row = std::max(nearest(b.low.y) - reach, lattice_.bottom); row <= top; ++row)
    for (int column = std::max(nearest(b.low.x) - reach, lattice_.left); column <= right; ++column) {
      const Vec2 p{column * kPitch, row * kPitch};
      State& state = points_[index(column, row)];
      if (state == State::free && distance_to(obstacle.shape, p) < radius) state = State::blocked;
    }
}

void Reach::flood(std::size_t from) {
  const auto columns = static_cast<std::size_t>(lattice_.columns);
  std::vector<std::size_t> open;
  const auto visit = [&](std::size_t point) {
    if (points_[point] != State::free) return;
    points_[point] = State::reached;
    open.push_back(point);
  };
  for (visit(from); !open.empty();) {
    const std::size_t point = open.back();
    open.pop_back();
    if (point % columns > 0) visit(point - 1);
    if (point % columns + 1 < columns) visit(point + 1);
    if (point >= columns) visit(point - columns);
    if (point + columns < points_.size()) visit(point + columns);
  }
}

bool Reach::reaches(Vec2 p) const { return holds(p) && points_[index(p)] == State::reached; }

bool Reach::holds(Vec2 p) const {
  const int column = nearest(p.x) - lattice_.left;
  const int row = nearest(p.y) - lattice_.bottom;
  return column >= 0 && row >= 0 && column < lattice_.columns && row < lattice_.rows;
}

std::size_t Reach::index(Vec2 p) const { return index(nearest(p.x), nearest(p.y)); }

std::size_t Reach::index(int column, int row) const {
  const auto columns = static_cast<std::size_t>(lattice_.columns);
  return static_cast<std::size_t>(row - lattice_.bottom) * columns +
         static_cast<std::size_t>(column - lattice_.left);
}

}  // namespace orca::sim::detail
