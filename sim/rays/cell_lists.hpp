// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cells.hpp"
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

}  // namespace orca::sim::detail
