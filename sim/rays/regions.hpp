// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cells.hpp"
#include "cone.hpp"
#include "elements.hpp"

namespace orca::sim::detail {

// Elements sorted into the cells of a uniform grid over the rectangle that they fill.
class CellLists {
 public:
  CellLists() = default;
  // Lists what of the elements with these numbers lies in an area; they are in ascending order in each cell.
  CellLists(const Elements& elements, std::span<const std::uint32_t> numbers, const Bounds& area);

  [[nodiscard]] const Cells& cells() const { return cells_; }
  [[nodiscard]] std::span<const std::uint32_t> at(std::size_t cell) const {
    return {entries_.data() + first_[cell], entries_.data() + first_[cell + 1]};
  }
  [[nodiscard]] bool is_empty(std::size_t cell) const { return first_[cell] == first_[cell + 1]; }

  // Returns how many elements share a cell with an average entry. It is small if they are spread evenly.
  [[nodiscard]] double crowd() const;
  // Returns true if smaller cells are allowed.
  [[nodiscard]] bool can_be_finer() const;

 private:
  template <class Visit>
  void for_cells_of(const Segment& segment, const Visit& visit) const;
  template <class Visit>
  void for_cells_of(const Circle& circle, const Visit& visit) const;

  Cells cells_;
  std::vector<std::uint32_t> first_;  // Cell c has the entries from first_[c] to before first_[c + 1].
  std::vector<std::uint32_t> entries_;
};

// The plane, cut in two again and again by upright or level lines, until what stands in each region is spread there
// about evenly. Each region has cells of its own. So one far post, or a long fence, does not make the cells of a room
// larger. A world that is filled evenly is one region.
class Regions {
 public:
  explicit Regions(const Elements& elements);

  // Calls visit(lists) for the regions that a ray crosses, nearest first. It stops at the first that begins at `best`
  // [m] or later; `visit` may lower `best`.
  template <class Visit>
  void cross(const Ray& ray, const double& best, const Visit& visit) const {
    if (nodes_.size() == 1) return visit(lists_.front());
    cross_from(0, ray, best, visit);
  }
  // Calls visit(lists) for the regions that rays of a cone may cross, and perhaps for others. Those on the tip's side
  // of a cut come before those on its other side.
  template <class Visit>
  void survey(const Cone& cone, const Visit& visit) const {
    if (nodes_.size() == 1) return visit(lists_.front());
    survey_from(0, cone, visit);
  }

  [[nodiscard]] std::size_t count() const { return lists_.size(); }

  // A line of equal x or y.
  struct Cut {
    bool by_x = true;
    double at = 0.0;  // [m]
  };

 private:
  struct Node {
    bool is_region = true;
    std::uint32_t next = 0;  // Number of its lists, or of the first of its two nodes: that below the cut.
    Cut cut;
    Bounds filled;  // By what stands in it.
  };

  struct Sides {
    std::vector<std::uint32_t> below, above;
  };

  void grow(std::uint32_t node, const Elements& elements, std::vector<std::uint32_t> numbers,
            const Bounds& area, int depth);
  [[nodiscard]] std::optional<Sides> sides_of(const Cut& cut, std::span<const std::uint32_t> numbers,
                                              std::span<const Bounds> parts);
  void divide(std::uint32_t node, const Cut& cut, const Elements& elements, Sides sides, const Bounds& area,
              int depth);

  template <class Visit>
  void cross_from(std::uint32_t number, const Ray& ray, const double& best, const Visit& visit) const;
  template <class Visit>
  void survey_from(std::uint32_t number, const Cone& cone, const Visit& visit) const;
  [[nodiscard]] static bool may_meet(const Cone& cone, const Bounds& filled);

  std::vector<Node> nodes_;
  std::vector<CellLists> lists_;  // One per region.
  std::size_t spare_ = 0;         // How many elements may still be cut in two.
};

template <class Visit>
void Regions::cross_from(std::uint32_t number, const Ray& ray, const double& best, const Visit& visit) const {
  const Node& node = nodes_[number];
  if (node.is_region) return visit(lists_[node.next]);
  const double start = node.cut.by_x ? ray.origin.x : ray.origin.y;
  const double along = node.cut.by_x ? ray.direction.x : ray.direction.y;
  const bool above = start > node.cut.at;
  cross_from(node.next + (above ? 1 : 0), ray, best, visit);
  // What lies on the cut belongs to both sides.
  const bool goes_over = above ? along < 0.0 : along > 0.0;
  if (goes_over && (node.cut.at - start) / along < best)
    cross_from(node.next + (above ? 0 : 1), ray, best, visit);
}

template <class Visit>
void Regions::survey_from(std::uint32_t number, const Cone& cone, const Visit& visit) const {
  const Node& node = nodes_[number];
  if (!may_meet(cone, node.filled)) return;
  if (node.is_region) return visit(lists_[node.next]);
  const bool above = (node.cut.by_x ? cone.tip.x : cone.tip.y) > node.cut.at;
  survey_from(node.next + (above ? 1 : 0), cone, visit);
  survey_from(node.next + (above ? 0 : 1), cone, visit);
}

}  // namespace orca::sim::detail
