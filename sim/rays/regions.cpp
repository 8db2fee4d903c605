// SPDX-License-Identifier: LGPL-3.0-or-later
#include "regions.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace orca::sim::detail {
namespace {

// Worlds that are filled evenly have a crowd of 3 to 4, bitmaps with their stairs of pixels about 12.
constexpr double kCrowded = 16.0;
constexpr std::size_t kLopsided = 10;     // One half holds so many times fewer elements than the whole,
constexpr std::size_t kFewElements = 32;  // if that has more elements than this.
constexpr double kWideGap = 0.5;  // As a part of what is filled: a gap so wide is cut out of the cells.
constexpr int kDeepest = 40;      // Halvings from 100 km to less than a micrometre.

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// The extent of something along one axis.
struct Extent {
  double low, high;
};

// Returns the widest stretch that no extent reaches into. Sorts them.
Extent widest_gap(std::vector<Extent>& extents) {
  std::ranges::sort(extents, {}, &Extent::low);
  Extent widest{0.0, 0.0};
  double reached = extents.front().high;
  for (const Extent& e : extents) {
    if (e.low - reached > widest.high - widest.low) widest = {reached, e.low};
    reached = std::max(reached, e.high);
  }
  return widest;
}

Extent extent(const Bounds& b, bool by_x) {
  return by_x ? Extent{b.low.x, b.high.x} : Extent{b.low.y, b.high.y};
}

double length(const Extent& e) { return e.high - e.low; }
double middle(const Extent& e) { return 0.5 * (e.low + e.high); }

Bounds around(std::span<const Bounds> parts) {
  Bounds all;
  for (const Bounds& part : parts) {
    all.add(part.low);
    all.add(part.high);
  }
  return all;
}

// Returns a line across the longer side.
Regions::Cut cut_in_half(std::span<const Bounds> parts) {
  const Bounds filled = around(parts);
  if (filled.empty()) return {};
  const Extent x = extent(filled, true);
  const Extent y = extent(filled, false);
  return length(x) >= length(y) ? Regions::Cut{true, middle(x)} : Regions::Cut{false, middle(y)};
}

// Returns a line through a gap that takes up most of a side, if there is one.
std::optional<Regions::Cut> cut_in_gap(std::span<const Bounds> parts) {
  if (parts.empty()) return std::nullopt;
  const Bounds filled = around(parts);
  for (const bool by_x : {true, false}) {
    std::vector<Extent> extents;
    extents.reserve(parts.size());
    for (const Bounds& part : parts) extents.push_back(extent(part, by_x));
    const Extent gap = widest_gap(extents);
    if (length(gap) > kWideGap * length(extent(filled, by_x))) return Regions::Cut{by_x, middle(gap)};
  }
  return std::nullopt;
}

bool is_below(const Bounds& part, const Regions::Cut& cut) {
  return extent(part, cut.by_x).low <= cut.at + Cells::kMargin;
}
bool is_above(const Bounds& part, const Regions::Cut& cut) {
  return extent(part, cut.by_x).high >= cut.at - Cells::kMargin;
}

// Returns true if nearly all elements are on one side of the cut.
bool is_lopsided(std::span<const Bounds> parts, const Regions::Cut& cut) {
  if (parts.size() <= kFewElements) return false;
  const auto below = static_cast<std::size_t>(
      std::ranges::count_if(parts, [&](const Bounds& part) { return is_below(part, cut); }));
  const auto above = static_cast<std::size_t>(
      std::ranges::count_if(parts, [&](const Bounds& part) { return is_above(part, cut); }));
  return kLopsided * std::min(below, above) < parts.size();
}

// Returns a cut that leaves few elements, or a wide gap, beside all others.
std::optional<Regions::Cut> cut_of_outliers(std::span<const Bounds> parts) {
  if (const auto gap = cut_in_gap(parts)) return gap;
  const Regions::Cut half = cut_in_half(parts);
  return is_lopsided(parts, half) ? std::optional(half) : std::nullopt;
}

// Returns the part of an area on one side of a line.
Bounds side_of(Bounds area, const Regions::Cut& cut, bool above) {
  const double beyond = above ? cut.at - Cells::kMargin : cut.at + Cells::kMargin;
  double& limit = above ? (cut.by_x ? area.low.x : area.low.y) : (cut.by_x ? area.high.x : area.high.y);
  limit = beyond;
  return area;
}

constexpr double kMinCell = 0.1;
constexpr double kMaxCells = 4e6;

// Returns cells for about one element per two cells; a limit on their side bounds the memory.
Cells cells_for(const Bounds& bounds, std::size_t elements) {
  if (bounds.empty()) return {};
  const double width = bounds.high.x - bounds.low.x;
  const double height = bounds.high.y - bounds.low.y;
  const auto count = static_cast<double>(elements);
  return {bounds, std::max({kMinCell, std::sqrt(width * height / (2.0 * count)),
                            std::max(width, height) / 4000.0, std::sqrt(width * height / kMaxCells)})};
}

Bounds bounds_of_all(const Elements& elements, std::span<const std::uint32_t> numbers, const Bounds& area) {
  Bounds all;
  for (const std::uint32_t number : numbers) {
    const Bounds one = bounds_in(elements, number, area);
    if (one.empty()) continue;
    all.add(one.low);
    all.add(one.high);
  }
  return all;
}

}  // namespace

Regions::Regions(const Elements& elements) : nodes_(1), spare_(elements.count()) {
  std::vector<std::uint32_t> all(elements.count());
  std::iota(all.begin(), all.end(), 0U);
  grow(0, elements, std::move(all), {{-kUnlimited, -kUnlimited}, {kUnlimited, kUnlimited}}, 0);
}

void Regions::grow(std::uint32_t node, const Elements& elements, std::vector<std::uint32_t> numbers,
                   const Bounds& area, int depth) {
  std::vector<Bounds> parts;
  parts.reserve(numbers.size());
  // What only grazes the area may have no part in it.
  std::erase_if(numbers, [&](std::uint32_t number) {
    const Bounds part = bounds_in(elements, number, area);
    if (!part.empty()) parts.push_back(part);
    return part.empty();
  });
  nodes_[node].filled = around(parts);
  std::optional<Cut> cut = depth < kDeepest ? cut_of_outliers(parts) : std::nullopt;
  CellLists lists;
  if (!cut) {
    lists = CellLists(elements, numbers, area);
    if (depth < kDeepest && lists.can_be_finer() && lists.crowd() > kCrowded) cut = cut_in_half(parts);
  }
  std::optional<Sides> sides = cut ? sides_of(*cut, numbers, parts) : std::nullopt;
  if (sides) {
    numbers = {};  // So that few such lists live at a time, however deep it goes.
    parts = {};
    return divide(node, *cut, elements, std::move(*sides), area, depth);
  }
  if (cut) lists = CellLists(elements, numbers, area);
  nodes_[node].next = static_cast<std::uint32_t>(lists_.size());
  lists_.push_back(std::move(lists));
}

// Returns which elements are on the two sides of a cut, or nothing if too many are on both.
std::optional<Regions::Sides> Regions::sides_of(const Cut& cut, std::span<const std::uint32_t> numbers,
                                                std::span<const Bounds> parts) {
  Sides sides;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (is_below(parts[i], cut)) sides.below.push_back(numbers[i]);
    if (is_above(parts[i], cut)) sides.above.push_back(numbers[i]);
  }
  const std::size_t twice = sides.below.size() + sides.above.size() - numbers.size();
  if (twice > spare_) return std::nullopt;
  spare_ -= twice;
  return sides;
}

void Regions::divide(std::uint32_t node, const Cut& cut, const Elements& elements, Sides sides,
                     const Bounds& area, int depth) {
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].is_region = false;
  nodes_[node].next = first;
  nodes_[node].cut = cut;
  grow(first, elements, std::move(sides.below), side_of(area, cut, false), depth + 1);
  grow(first + 1, elements, std::move(sides.above), side_of(area, cut, true), depth + 1);
}

// Returns false if all of it lies outside a rim, behind the tip or beyond the end.
bool Regions::may_meet(const Cone& cone, const Bounds& filled) {
  const double slack = cone.slack + 2.0 * Cells::kMargin;
  // Returns the least component of the rectangle along a normal, as seen from the tip.
  const auto least = [&](Vec2 normal) {
    const Vec2 corner{normal.x > 0.0 ? filled.low.x : filled.high.x,
                      normal.y > 0.0 ? filled.low.y : filled.high.y};
    return dot(normal, corner - cone.tip);
  };
  return least({-cone.left.y, cone.left.x}) <= slack && least({cone.right.y, -cone.right.x}) <= slack &&
         least(-1.0 * cone.axis) <= slack && least(cone.axis) <= cone.reach + slack;
}

// Sorts the elements into the cells by a counting sort: count, sum up, fill.
CellLists::CellLists(const Elements& elements, std::span<const std::uint32_t> numbers, const Bounds& area)
    : cells_(cells_for(bounds_of_all(elements, numbers, area), numbers.size())) {
  const auto for_all_entries = [&](const auto& visit) {
    for (const std::uint32_t number : numbers) {
      const auto enter = [&](std::size_t cell) { visit(cell, number); };
      elements.with(
          number,
          [&](const Elements::Edge& edge) {
            if (const auto part = part_in(edge.segment, area)) for_cells_of(*part, enter);
          },
          [&](const Elements::Round& round) { for_cells_of(round.circle, enter); });
    }
  };
  first_.assign(cells_.count() + 1, 0);
  for_all_entries([&](std::size_t c, std::uint32_t) { ++first_[c + 1]; });
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  entries_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_all_entries([&](std::size_t c, std::uint32_t number) { entries_[next[c]++] = number; });
}

// Visits the cells row by row: the part of the segment inside a row (and a margin) spans a range of columns.
template <class Visit>
void CellLists::for_cells_of(const Segment& s, const Visit& visit) const {
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
void CellLists::for_cells_of(const Circle& circle, const Visit& visit) const {
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

double CellLists::crowd() const {
  double squares = 0.0;
  for (std::size_t c = 0; c < cells_.count(); ++c) {
    const auto count = static_cast<double>(at(c).size());
    squares += count * count;
  }
  return entries_.empty() ? 0.0 : squares / static_cast<double>(entries_.size());
}

bool CellLists::can_be_finer() const { return cells_.size() > kMinCell; }

}  // namespace orca::sim::detail
