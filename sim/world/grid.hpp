// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "orca/sim/caster.hpp"

namespace orca::sim::detail {

// The static part of a world, sorted into the cells of a uniform grid. Every element is listed in each cell
// that it touches and, by a small margin, in those that it nearly touches, so rounding cannot hide it.
class Grid {
 public:
  explicit Grid(const WorldModel& world);

  // The nearest element on the ray closer than `best`; `best` becomes its distance.
  [[nodiscard]] Surface cast(const Ray& ray, double& best) const;

 private:
  struct Edge {
    Segment segment;
    double height;
  };
  struct Round {
    Circle circle;
    double height;
  };
  struct Walk;

  void collect(const WorldModel& world);
  void choose_cells(const Bounds& bounds);
  void sort_in();
  template <class Visit>
  void for_cells_of(const Segment& segment, const Visit& visit) const;
  template <class Visit>
  void for_cells_of(const Circle& circle, const Visit& visit) const;
  template <class Visit>
  void for_all_entries(const Visit& visit) const;
  [[nodiscard]] int column(double x) const;
  [[nodiscard]] int row(double y) const;
  [[nodiscard]] std::size_t cell(int column, int row) const;
  void test_cell(std::size_t cell, const Ray& ray, double& best, std::uint32_t& nearest) const;
  [[nodiscard]] bool enter(const Ray& ray, double best, double& t) const;
  [[nodiscard]] Surface surface(std::uint32_t element) const;

  // Elements are numbered: first the edges, then the circles.
  std::vector<Edge> edges_;
  std::vector<Round> rounds_;
  Vec2 origin_;
  double cell_size_ = 1.0;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<std::uint32_t> first_;  // Of cell c: the entries first_[c] .. first_[c + 1].
  std::vector<std::uint32_t> entries_;
};

}  // namespace orca::sim::detail
