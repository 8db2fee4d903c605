// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cells.hpp"
#include "cone.hpp"

namespace orca::sim::detail {

class Panorama;

// The heights between which a solid lies [m]. A sensor at exactly `bottom` sees it, one at exactly `top` does
// not.
struct Heights {
  double bottom = 0.0;
  double top = 0.0;
  [[nodiscard]] bool hold(double height) const { return bottom <= height && height < top; }
};

// The boundaries that never move, sorted into the cells of a uniform grid.
class Grid {
 public:
  // The boundaries of upright solids.
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

  // Replaces the hit, with its element number, by the nearest element on the ray if that is closer.
  // @pre  the ray meets no element before `from` [m].
  void cast(const Ray& ray, Hit& hit, double from = 0.0) const;

  // Returns a distance [m] before which no ray of the cone meets anything. The true one may be larger.
  [[nodiscard]] double empty_depth(const Cone& cone) const;

  // Adds to the view of a cone all elements that can be seen in it, and perhaps some that cannot. An element's
  // number is `first` plus `step` times its number here.
  void show(const Cone& cone, std::uint64_t first, std::uint64_t step, Panorama& view) const;

 private:
  void sort_in();
  void show_part(const Cone& cone, std::uint64_t first, std::uint64_t step, Panorama& view) const;
  template <class Visit>
  void for_cells_of(const Segment& segment, const Visit& visit) const;
  template <class Visit>
  void for_cells_of(const Circle& circle, const Visit& visit) const;
  template <class Visit>
  void for_all_entries(const Visit& visit) const;

  Elements elements_;  // Numbered: first the edges, then the circles.
  Cells cells_;
  std::vector<std::uint32_t> first_;  // Cell c has the entries from first_[c] to before first_[c + 1].
  std::vector<std::uint32_t> entries_;
};

}  // namespace orca::sim::detail
