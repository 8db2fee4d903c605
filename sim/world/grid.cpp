// SPDX-License-Identifier: LGPL-3.0-or-later
#include "grid.hpp"

#include <algorithm>

#include "intersect.hpp"

namespace orca::sim::detail {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
// [m] Cells are listed as touched from this far away; far above rounding in worlds of up to 100 km.
constexpr double kMargin = 1e-6;
constexpr double kMinCell = 0.1;
constexpr double kMaxCells = 4e6;

// Limited before it becomes an integer, so that no value, not even NaN, is out of range.
int cell_number(double cells, int count) {
  return static_cast<int>(std::fmax(0.0, std::fmin(std::floor(cells), count - 1.0)));
}

}  // namespace

Grid::Grid(const WorldModel& world) {
  collect(world);
  Bounds bounds;
  for (const Edge& e : edges_) {
    bounds.add(e.segment.a);
    bounds.add(e.segment.b);
  }
  for (const Round& r : rounds_) bounds.add(r.circle);
  if (bounds.empty()) return;
  choose_cells(bounds);
  sort_in();
}

void Grid::collect(const WorldModel& world) {
  for (const Obstacle& o : world.obstacles) {
    if (const auto* circle = std::get_if<Circle>(&o.shape)) rounds_.push_back({*circle, o.height});
    for (const Segment& s : edges_of(o.shape)) edges_.push_back({s, o.height});
  }
}

void Grid::choose_cells(const Bounds& bounds) {
  const double width = bounds.high.x - bounds.low.x + 4.0 * kMargin;
  const double height = bounds.high.y - bounds.low.y + 4.0 * kMargin;
  const double elements = static_cast<double>(edges_.size() + rounds_.size());
  // About one element per two cells; the side also keeps the number of cells in memory reasonable.
  cell_size_ = std::max({kMinCell, std::sqrt(width * height / (2.0 * elements)),
                         std::max(width, height) / 4000.0, std::sqrt(width * height / kMaxCells)});
  origin_ = bounds.low - Vec2{2.0 * kMargin, 2.0 * kMargin};
  columns_ = static_cast<int>(width / cell_size_) + 1;
  rows_ = static_cast<int>(height / cell_size_) + 1;
}

int Grid::column(double x) const { return cell_number((x - origin_.x) / cell_size_, columns_); }
int Grid::row(double y) const { return cell_number((y - origin_.y) / cell_size_, rows_); }
std::size_t Grid::cell(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

// Row by row: the part of the segment inside the row (and a margin) spans a range of columns.
template <class Visit>
void Grid::for_cells_of(const Segment& s, const Visit& visit) const {
  const Segment up = s.a.y <= s.b.y ? s : Segment{s.b, s.a};
  const double rise = up.b.y - up.a.y;
  const auto x_at = [&](double y) {
    return rise == 0.0 ? up.a.x : up.a.x + std::clamp((y - up.a.y) / rise, 0.0, 1.0) * (up.b.x - up.a.x);
  };
  for (int r = row(up.a.y - kMargin); r <= row(up.b.y + kMargin); ++r) {
    const double low = origin_.y + r * cell_size_ - kMargin;
    const double xa = rise == 0.0 ? up.a.x : x_at(low);
    const double xb = rise == 0.0 ? up.b.x : x_at(low + cell_size_ + 2.0 * kMargin);
    for (int c = column(std::min(xa, xb) - kMargin); c <= column(std::max(xa, xb) + kMargin); ++c)
      visit(cell(c, r));
  }
}

template <class Visit>
void Grid::for_cells_of(const Circle& circle, const Visit& visit) const {
  const double reach = circle.radius + kMargin;
  const double diagonal = 1.5 * cell_size_;
  for (int r = row(circle.center.y - reach); r <= row(circle.center.y + reach); ++r)
    for (int c = column(circle.center.x - reach); c <= column(circle.center.x + reach); ++c) {
      // Cells well inside or outside the circle hold none of its boundary.
      const Vec2 middle = origin_ + cell_size_ * Vec2{c + 0.5, r + 0.5};
      if (std::fabs(norm(middle - circle.center) - circle.radius) < diagonal + kMargin) visit(cell(c, r));
    }
}

template <class Visit>
void Grid::for_all_entries(const Visit& visit) const {
  std::uint32_t element = 0;
  for (const Edge& e : edges_) {
    for_cells_of(e.segment, [&](std::size_t c) { visit(c, element); });
    ++element;
  }
  for (const Round& r : rounds_) {
    for_cells_of(r.circle, [&](std::size_t c) { visit(c, element); });
    ++element;
  }
}

// A counting sort: count, sum up, fill.
void Grid::sort_in() {
  first_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for_all_entries([&](std::size_t c, std::uint32_t) { ++first_[c + 1]; });
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  entries_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_all_entries([&](std::size_t c, std::uint32_t element) { entries_[next[c]++] = element; });
}

void Grid::test_cell(std::size_t c, const Ray& ray, double& best, std::uint32_t& nearest) const {
  for (std::uint32_t i = first_[c]; i < first_[c + 1]; ++i) {
    const std::uint32_t element = entries_[i];
    if (element < edges_.size()) {
      const Edge& e = edges_[element];
      if (e.height > ray.sensor_height && meet(ray.origin, ray.direction, e.segment, best)) nearest = element;
    } else {
      const Round& r = rounds_[element - edges_.size()];
      if (r.height > ray.sensor_height && meet(ray.origin, ray.direction, r.circle, best)) nearest = element;
    }
  }
}

Surface Grid::surface(std::uint32_t element) const {
  if (element == kNone) return {};
  if (element < edges_.size()) return edges_[element].segment;
  return rounds_[element - edges_.size()].circle;
}

// Clips the ray to the grid: false if it passes by within `best`; else `t` is where it enters.
bool Grid::enter(const Ray& ray, double best, double& t) const {
  double leave = best;
  t = 0.0;
  const auto clip = [&](double o, double u, double low, double size) {
    if (u == 0.0) return o >= low && o <= low + size;
    const double t1 = (low - o) / u;
    const double t2 = (low + size - o) / u;
    t = std::max(t, std::min(t1, t2));
    leave = std::min(leave, std::max(t1, t2));
    return true;
  };
  return clip(ray.origin.x, ray.direction.x, origin_.x, columns_ * cell_size_) &&
         clip(ray.origin.y, ray.direction.y, origin_.y, rows_ * cell_size_) && t <= leave;
}

// The walk along one axis: where the ray leaves the present cell. Computed afresh from the cell's number each
// time, so that rounding does not add up along long rays.
struct Grid::Walk {
  double start;
  double slope;
  double origin;
  double size;
  int at;
  [[nodiscard]] double exit() const {
    if (slope == 0.0) return std::numeric_limits<double>::infinity();
    return (origin + (at + (slope > 0.0 ? 1 : 0)) * size - start) / slope;
  }
  void advance() { at += slope > 0.0 ? 1 : -1; }
};

Surface Grid::cast(const Ray& ray, double& best) const {
  double t = 0.0;
  if (first_.empty() || !enter(ray, best, t)) return {};
  const Vec2 p = ray.origin + t * ray.direction;
  Walk x{ray.origin.x, ray.direction.x, origin_.x, cell_size_, column(p.x)};
  Walk y{ray.origin.y, ray.direction.y, origin_.y, cell_size_, row(p.y)};
  std::uint32_t nearest = kNone;
  while (x.at >= 0 && y.at >= 0 && x.at < columns_ && y.at < rows_) {
    test_cell(cell(x.at, y.at), ray, best, nearest);
    const double exit_x = x.exit();
    const double exit_y = y.exit();
    if (best <= std::min(exit_x, exit_y)) break;
    (exit_x < exit_y ? x : y).advance();
  }
  return surface(nearest);
}

}  // namespace orca::sim::detail
