// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "orca/sim/geometry.hpp"

namespace orca::sim::detail {

// Many circles, of which all are asked for each cone: column by column and in single precision, so that the
// compiler looks at four at once. It errs on the side of finding too many.
class Discs {
 public:
  // Up to a right angle wide.
  struct Cone {
    Vec2 tip;
    Vec2 axis;          // Of length 1.
    double half_angle;  // [rad]
    double reach;       // [m]
  };

  // @param number  the next one, or one that is there already.
  void set(std::size_t number, const Circle& circle);

  // The numbers of all that may come nearer than `slack` [m] to the cone, in their order.
  [[nodiscard]] std::vector<std::uint32_t> near(const Cone& cone, double slack) const;

 private:
  // The cone, as the columns have it.
  struct Question {
    Question(const Cone& cone, double slack);
    float tip_x, tip_y, left_x, left_y, right_x, right_y, axis_x, axis_y, reach, wider;
  };

  // Of the circles from `first` on.
  void mark(const Question& asked, std::size_t first, std::size_t count, std::int32_t* marks) const;

  std::vector<float> x_, y_, radius_;
};

}  // namespace orca::sim::detail
