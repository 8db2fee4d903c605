// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cells.hpp"
#include "cone.hpp"

namespace orca::sim::detail {

// From where to where a solid reaches [m]. A sensor at the height of its bottom sees it, one at its top not.
struct Heights {
  double bottom = 0.0;
  double top = 0.0;
  [[nodiscard]] bool hold(double height) const { return bottom <= height && height < top; }
};

// What stands still, sorted into the cells of a uniform grid.
class Grid {
 public:
  // Boundaries of upright solids.
  struct Elements {
    void add(const Shape& shape, Heights heights);
    struct Edge {
      Segment segment;
      Heights heights;
    };
    struct Round {
      Circle circle;
      Heights heights;
    };
    std::vector<Edge> edges;
    std::vector<Round> rounds;
  };

  explicit Grid(Elements elements);

  // The nearest element on the ray closer than the hit, which it then becomes, with its number.
  // @pre  it meets none before `from` [m].
  void cast(const Ray& ray, Hit& hit, double from = 0.0) const;

  // No ray of the cone meets anything nearer [m]; it may be empty farther.
  [[nodiscard]] double empty_depth(const Cone& cone) const;

 private:
  void sort_in();
  template <class Visit>
  void for_cells_of(const Segment& segment, const Visit& visit) const;
  template <class Visit>
  void for_cells_of(const Circle& circle, const Visit& visit) const;
  template <class Visit>
  void for_all_entries(const Visit& visit) const;

  // Numbered: first the edges, then the circles.
  Elements elements_;
  Cells cells_;
  std::vector<std::uint32_t> first_;  // Of cell c: the entries first_[c] .. first_[c + 1].
  std::vector<std::uint32_t> entries_;
};

}  // namespace orca::sim::detail
