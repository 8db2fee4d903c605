// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "cone.hpp"
#include "orca/sim/figures.hpp"

namespace orca::sim::detail {

// Many circles, of which all are asked for each cone: column by column and in single precision, so that the
// compiler looks at four at once. It errs on the side of finding too many.
class Discs {
 public:
  // @param number  the next one, or one that is there already.
  void set(std::size_t number, const Circle& circle);

  // Adds the numbers of all that rays of the cone may meet, in their order.
  void find_near(const Cone& cone, std::vector<std::uint32_t>& found) const;

 private:
  // The cone, as the columns have it.
  struct Question {
    explicit Question(const Cone& cone);
    float tip_x, tip_y, left_x, left_y, right_x, right_y, axis_x, axis_y, reach, wider;
  };

  // Of the circles from `first` on.
  void mark(const Question& asked, std::size_t first, std::size_t count, std::int32_t* marks) const;

  std::vector<float> x_, y_, radius_;
};

}  // namespace orca::sim::detail
