// SPDX-License-Identifier: LGPL-3.0-or-later
#include "grid.hpp"

#include <utility>

#include "intersect.hpp"
#include "strips.hpp"

namespace orca::sim::detail {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
constexpr double kMinCell = 0.1;
constexpr double kMaxCells = 4e6;
// Largest number of cells that are searched for a cone: a wide search over small cells costs more than the
// rays.
constexpr int kMostLooks = 128;

Bounds bounds_of(const Grid::Elements& elements) {
  Bounds bounds;
  for (const auto& e : elements.edges) {
    bounds.add(e.segment.a);
    bounds.add(e.segment.b);
  }
  for (const auto& r : elements.rounds) bounds.add(r.circle);
  return bounds;
}

// Returns cells for about one element per two cells; a limit on their side bounds the memory.
Cells cells_for(const Grid::Elements& elements) {
  const Bounds bounds = bounds_of(elements);
  if (bounds.empty()) return {};
  const double width = bounds.high.x - bounds.low.x;
  const double height = bounds.high.y - bounds.low.y;
  const auto count = static_cast<double>(elements.edges.size() + elements.rounds.size());
  return {bounds, std::max({kMinCell, std::sqrt(width * height / (2.0 * count)),
                            std::max(width, height) / 4000.0, std::sqrt(width * height / kMaxCells)})};
}

}  // namespace

void Grid::Elements::add(const Shape& shape, Heights heights) {
  if (const auto* circle = std::get_if<Circle>(&shape)) rounds.push_back({*circle, heights});
  for (const Segment& s : edges_of(shape)) edges.push_back({s, heights});
}

Grid::Grid(Elements elements) : elements_(std::move(elements)), cells_(cells_for(elements_)) { sort_in(); }

// Visits the cells row by row: the part of the segment inside a row (and a margin) spans a range of columns.
template <class Visit>
void Grid::for_cells_of(const Segment& s, const Visit& visit) const {
  const Segment up = s.a.y <= s.b.y ? s : Segment{s.b, s.a};
  const double rise = up.b.y - up.a.y;
  const auto x_at = [&](double y) {
    return up.a.x + std::clamp((y - up.a.y) / rise, 0.0, 1.0) * (up.b.x - up.a.x);
  };
  for (int r = cells_.row(up.a.y - Cells::kMargin); r <= cells_.row(up.b.y + Cells::kMargin); ++r) {
    const double low = cells_.low(0, r).y - Cells::kMargin;
    const double xa = rise == 0.0 ? up.a.x : x_at(low);
    const double xb = rise == 0.0 ? up.b.x : x_at(low + cells_.size() + 2.0 * Cells::kMargin);
    for (int c = cells_.column(std::min(xa, xb) - Cells::kMargin);
         c <= cells_.column(std::max(xa, xb) + Cells::kMargin); ++c)
      visit(cells_.cell(c, r));
  }
}

template <class Visit>
void Grid::for_cells_of(const Circle& circle, const Visit& visit) const {
  Bounds around;
  around.add(circle);
  const Cells::Range range = cells_.range(around);
  const double diagonal = 1.5 * cells_.size();
  for (int r = range.first_row; r <= range.last_row; ++r)
    for (int c = range.first_column; c <= range.last_column; ++c) {
      // Cells well inside or outside the circle hold none of its boundary.
      const Vec2 middle = cells_.low(c, r) + 0.5 * cells_.size() * Vec2{1.0, 1.0};
      if (std::fabs(norm(middle - circle.center) - circle.radius) < diagonal + Cells::kMargin)
        visit(cells_.cell(c, r));
    }
}

template <class Visit>
void Grid::for_all_entries(const Visit& visit) const {
  std::uint32_t element = 0;
  for (const auto& e : elements_.edges) {
    for_cells_of(e.segment, [&](std::size_t c) { visit(c, element); });
    ++element;
  }
  for (const auto& r : elements_.rounds) {
    for_cells_of(r.circle, [&](std::size_t c) { visit(c, element); });
    ++element;
  }
}

// Sorts the elements into the cells by a counting sort: count, sum up, fill.
void Grid::sort_in() {
  first_.assign(cells_.count() + 1, 0);
  for_all_entries([&](std::size_t c, std::uint32_t) { ++first_[c + 1]; });
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  entries_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_all_entries([&](std::size_t c, std::uint32_t element) { entries_[next[c]++] = element; });
}

void Grid::cast(const Ray& ray, Hit& hit, double from) const {
  const auto edges = static_cast<std::uint32_t>(elements_.edges.size());
  std::uint32_t nearest = kNone;
  const auto test = [&](const auto& boundary, Heights heights, std::uint32_t element) {
    double range = hit.range;
    if (!meet(ray.origin, ray.direction, boundary, range) || !heights.hold(ray.sensor_height)) return;
    hit.range = range;
    nearest = element;
  };
  cells_.walk(ray, from, hit.range, [&](std::size_t cell) {
    for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      const std::uint32_t element = entries_[i];
      if (element < edges) {
        const Elements::Edge& e = elements_.edges[element];
        test(e.segment, e.heights, element);
      } else {
        const Elements::Round& r = elements_.rounds[element - edges];
        test(r.circle, r.heights, element);
      }
    }
  });
  if (nearest == kNone) return;
  hit.element = nearest;
  if (nearest < edges) {
    hit.surface = elements_.edges[nearest].segment;
  } else {
    hit.surface = elements_.rounds[nearest - edges].circle;
  }
}

double Grid::empty_depth(const Cone& cone) const {
  if (cone.half_angle > Strips::kWide) return 0.0;
  Strips strips(cells_, cone);
  for (int looks = 0; looks < kMostLooks && strips.begin() < cone.reach;) {
    const double depth = strips.begin();
    bool filled = false;
    strips.next([&](std::size_t c) {
      filled = filled || first_[c] != first_[c + 1];
      ++looks;
    });
    if (filled) return depth;
  }
  return std::min(strips.begin(), cone.reach);
}

}  // namespace orca::sim::detail
