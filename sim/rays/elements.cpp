// SPDX-License-Identifier: LGPL-3.0-or-later
#include "elements.hpp"

#include <algorithm>

namespace orca::sim::detail {
namespace {

Bounds common(const Bounds& a, const Bounds& b) {
  Bounds both;
  both.low = {std::fmax(a.low.x, b.low.x), std::fmax(a.low.y, b.low.y)};
  both.high = {std::fmin(a.high.x, b.high.x), std::fmin(a.high.y, b.high.y)};
  return both.low.x <= both.high.x && both.low.y <= both.high.y ? both : Bounds{};
}

}  // namespace

void Elements::add(const Shape& shape, Heights heights) {
  if (const auto* circle = std::get_if<Circle>(&shape)) rounds.push_back({*circle, heights});
  for (const Segment& s : edges_of(shape)) edges.push_back({s, heights});
}

// Liang and Barsky's clipping.
std::optional<Segment> part_in(const Segment& edge, const Bounds& area) {
  const Vec2 along = edge.b - edge.a;
  double from = 0.0;
  double to = 1.0;
  const auto clip = [&](double start, double way, double low, double high) {
    if (way == 0.0) return start >= low && start <= high;
    const auto [enters, leaves] = std::minmax({(low - start) / way, (high - start) / way});
    from = std::max(from, enters);
    to = std::min(to, leaves);
    return from <= to;
  };
  if (!clip(edge.a.x, along.x, area.low.x, area.high.x) || !clip(edge.a.y, along.y, area.low.y, area.high.y))
    return std::nullopt;
  // The sum of a point and a difference need not give the other point.
  return Segment{from == 0.0 ? edge.a : edge.a + from * along, to == 1.0 ? edge.b : edge.a + to * along};
}

Bounds bounds_in(const Elements& elements, std::uint32_t number, const Bounds& area) {
  Bounds bounds;
  elements.with(
      number,
      [&](const Elements::Edge& edge) {
        if (const auto part = part_in(edge.segment, area)) {
          bounds.add(part->a);
          bounds.add(part->b);
        }
      },
      [&](const Elements::Round& round) {
        bounds.add(round.circle);
        bounds = common(bounds, area);
      });
  return bounds;
}

}  // namespace orca::sim::detail
