// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cone.hpp"
#include "orca/sim/figures.hpp"

namespace orca::sim::detail {

// A set of circles that is searched whole for each cone. Its columns are in single precision, so that the
// compiler handles four circles at once. Rounding may add circles to the result, but never removes one.
class Discs {
 public:
  // Adds or replaces a circle. @param number  the next free one, or one in use.
  void set(std::size_t number, const Circle& circle);

  // Appends to `found` the numbers of all circles that rays of the cone may meet, in ascending order.
  void find_near(const Cone& cone, std::vector<std::uint32_t>& found) const;

 private:
  // The cone in the precision of the columns.
  struct Question {
    explicit Question(const Cone& cone);
    float tip_x, tip_y, left_x, left_y, right_x, right_y, axis_x, axis_y, reach, wider;
  };

  // Marks which of the `count` circles that begin at `first` the cone may meet.
  void mark(const Question& asked, std::size_t first, std::size_t count, std::int32_t* marks) const;

  std::vector<float> x_, y_, radius_;
};

}  // namespace orca::sim::detail
