// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cells.hpp"

namespace orca::sim::detail {

// What moves, listed in the cells of a uniform grid of its own. Few moves change a list, so a move costs
// little.
class Bodies {
 public:
  std::size_t add(Body body);
  void move(std::size_t number, Shape shape);
  void remove(std::size_t number);

  // The nearest body on the ray closer than `best`, which becomes its distance; nothing leaves `surface`
  // alone.
  void cast(const Ray& ray, double& best, Surface& surface) const;

 private:
  // A body, with its edges and its surroundings worked out once per move.
  struct Moving {
    explicit Moving(Body b);
    void refresh();
    void cast(const Ray& ray, double& best, Surface& surface) const;

    Body body;
    bool present = true;
    std::vector<Segment> edges;
    Bounds bounds;
    Cells::Range listed{};
  };

  // What tells of most bodies that a ray passes them by; small, since rays look at many.
  struct Outer {
    explicit Outer(const Moving& moving);
    [[nodiscard]] bool in_reach(const Ray& ray, double best) const;
    Circle around;
    double bottom, top;
  };

  void place(std::size_t number);
  void list(std::size_t number);
  void unlist(std::size_t number);
  void choose_cells();

  std::vector<Moving> bodies_;
  std::vector<Outer> outer_;  // Of each body.
  Cells cells_;
  std::vector<std::vector<std::uint32_t>> lists_;  // Of the bodies' numbers, per cell.
};

}  // namespace orca::sim::detail
