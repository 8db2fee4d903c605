// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/goals/route.hpp"

namespace orca::go {

void Route::add(const Point& point, TimePoint now) {
  if (!points_.empty() && (!points_.back()->via() || points_.back()->mission() != point->mission()))
    points_.clear();
  if (points_.empty()) begun_ = now;
  points_.push_back(point);
  ++changes_;
}

void Route::give_up(std::uint64_t mission) {
  std::erase_if(points_, [mission](const Point& point) { return point->mission() == mission; });
  given_up_ = mission;
  ++changes_;
}

bool Route::is_given_up(const idl::GoalPoint& point) const {
  return given_up_ != 0 && point.mission() == given_up_;
}

}  // namespace orca::go
