// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cell_lists.hpp"

namespace orca::sim::detail {
namespace {

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
