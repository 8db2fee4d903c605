// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>

#include "orca/geometry/vec2.hpp"
#include "orca/sim/caster.hpp"

namespace orca::sim::detail {

// A rectangle of the plane, cut into square cells. A grid lists each thing in every cell that it touches, and
// in those that it misses by less than a margin, so that rounding cannot hide it.
class Cells {
 public:
  // [m] Far above the rounding error of a walk in worlds of up to 100 km.
  static constexpr double kMargin = 1e-6;

  struct Range {
    int first_column, last_column, first_row, last_row;
    [[nodiscard]] std::size_t count() const {
      return static_cast<std::size_t>(last_column - first_column + 1) *
             static_cast<std::size_t>(last_row - first_row + 1);
    }
    friend bool operator==(const Range&, const Range&) = default;
  };

  Cells() = default;  // Has no cells.
  // Covers at least `bounds` and twice the margin around it, with cells of side `size` [m].
  Cells(const Bounds& bounds, double size)
      : origin_(bounds.low - Vec2{2.0 * kMargin, 2.0 * kMargin}),
        size_(size),
        columns_(static_cast<int>((bounds.high.x - bounds.low.x + 4.0 * kMargin) / size) + 1),
        rows_(static_cast<int>((bounds.high.y - bounds.low.y + 4.0 * kMargin) / size) + 1) {}

  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }
  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] Vec2 low(int column, int row) const {
    return origin_ + size_ * Vec2{1.0 * column, 1.0 * row};
  }
  [[nodiscard]] int column(double x) const { return number((x - origin_.x) / size_, columns_); }
  [[nodiscard]] int row(double y) const { return number((y - origin_.y) / size_, rows_); }
  [[nodiscard]] std::size_t cell(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  // Returns the cells that the rectangle touches or nearly touches.
  [[nodiscard]] Range range(const Bounds& b) const {
    return {column(b.low.x - kMargin), column(b.high.x + kMargin), row(b.low.y - kMargin),
            row(b.high.y + kMargin)};
  }
  [[nodiscard]] bool hold(const Bounds& b) const {
    const Vec2 end = low(columns_, rows_);
    return b.low.x - kMargin > origin_.x && b.low.y - kMargin > origin_.y && b.high.x + kMargin < end.x &&
           b.high.y + kMargin < end.y;
  }

  // Calls visit(cell) for the cells on the ray beyond the distance `from` [m], nearest first. It stops at the
  // first cell that begins at `best` [m] or later; `visit` may lower `best`.
  template <class Visit>
  void walk(const Ray& ray, double from, const double& best, const Visit& visit) const;

 private:
  // One direction of a ray.
  struct Slope {
    double start;    // [m] Coordinate of the ray's origin.
    double along;    // Component of the ray's direction.
    double inverse;  // 1 / along.
  };

  // One direction of a walk: where the ray leaves the present cell, and how many cells follow. Over the 4000
  // cells that a side has at most where things stand, rounding errors sum up to 1e-7 m at most.
  struct Axis {
    Axis(const Slope& ray, double low, double size, int at, int cells, std::ptrdiff_t stride)
        : exit((low + (ray.along > 0.0 ? size : 0.0) - ray.start) * ray.inverse),
          per_cell(size * std::fabs(ray.inverse)),
          left(ray.along > 0.0 ? cells - 1 - at : at),
          step(ray.along > 0.0 ? stride : -stride) {
      if (ray.along == 0.0) exit = std::numeric_limits<double>::infinity();
    }
    void advance(std::ptrdiff_t& cell) {
      exit += per_cell;
      --left;
      cell += step;
    }
    double exit;
    double per_cell;
    int left;
    std::ptrdiff_t step;
  };

  // Limits the value before the conversion to an integer, so that no value, not even NaN, is out of range.
  static int number(double cells, int count) {
    return static_cast<int>(std::min(std::max(0.0, cells), count - 1.0));
  }

  // Raises `t` [m] to the distance at which the ray enters the rectangle. Returns false if the ray does not
  // enter it before `best` [m].
  [[nodiscard]] bool enter(const Slope& x, const Slope& y, double best, double& t) const {
    const Vec2 end = low(columns_, rows_);
    double leave = best;
    const auto clip = [&](const Slope& ray, double from, double to) {
      if (ray.along == 0.0) return ray.start >= from && ray.start <= to;
      const double t1 = (from - ray.start) * ray.inverse;
      const double t2 = (to - ray.start) * ray.inverse;
      t = std::max(t, std::min(t1, t2));
      leave = std::min(leave, std::max(t1, t2));
      return true;
    };
    return clip(x, origin_.x, end.x) && clip(y, origin_.y, end.y) && t <= leave;
  }

  Vec2 origin_;
  double size_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
};

template <class Visit>
void Cells::walk(const Ray& ray, double from, const double& best, const Visit& visit) const {
  const Slope along_x{ray.origin.x, ray.direction.x, 1.0 / ray.direction.x};
  const Slope along_y{ray.origin.y, ray.direction.y, 1.0 / ray.direction.y};
  double t = from;
  if (count() == 0 || !enter(along_x, along_y, best, t)) return;
  const Vec2 p = ray.origin + t * ray.direction;
  const int c = column(p.x);
  const int r = row(p.y);
  const Vec2 corner = low(c, r);
  Axis x(along_x, corner.x, size_, c, columns_, 1);
  Axis y(along_y, corner.y, size_, r, rows_, columns_);
  for (auto at = static_cast<std::ptrdiff_t>(cell(c, r));;) {
    visit(static_cast<std::size_t>(at));
    if (x.exit < y.exit) {
      if (best <= x.exit || x.left == 0) return;
      x.advance(at);
    } else {
      if (best <= y.exit || y.left == 0) return;
      y.advance(at);
    }
  }
}

}  // namespace orca::sim::detail
