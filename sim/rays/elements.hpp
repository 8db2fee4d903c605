// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "orca/sim/figures.hpp"
#include "orca/sim/shape.hpp"

namespace orca::sim::detail {

// The heights between which a solid lies [m]. A sensor at exactly `bottom` sees it, one at exactly `top` does
// not.
struct Heights {
  double bottom = 0.0;
  double top = 0.0;
  [[nodiscard]] bool hold(double height) const { return bottom <= height && height < top; }
};

// The boundaries of upright solids, numbered: first the edges, then the circles.
struct Elements {
  struct Edge {
    Segment segment;
    Heights heights;
  };
  struct Round {
    Circle circle;
    Heights heights;
  };

  void add(const Shape& shape, Heights heights);

  [[nodiscard]] std::size_t count() const { return edges.size() + rounds.size(); }
  // Calls one of two functions, with the edge or with the circle of that number.
  template <class OnEdge, class OnRound>
  decltype(auto) with(std::uint32_t number, const OnEdge& on_edge, const OnRound& on_round) const {
    return number < edges.size() ? on_edge(edges[number]) : on_round(rounds[number - edges.size()]);
  }

  std::vector<Edge> edges;
  std::vector<Round> rounds;
};

// Returns the part of an edge in a rectangle, if there is any. Ends that lie in it stay as they are, bit for bit.
[[nodiscard]] std::optional<Segment> part_in(const Segment& edge, const Bounds& area);

// Returns the rectangle around what of an element lies in an area; empty if nothing does. That of a circle may be too
// large.
[[nodiscard]] Bounds bounds_in(const Elements& elements, std::uint32_t number, const Bounds& area);

}  // namespace orca::sim::detail
