// SPDX-License-Identifier: LGPL-3.0-or-later
#include "discs.hpp"

#include "single_precision.hpp"

namespace orca::sim::detail {

void Discs::set(std::size_t number, const Circle& circle) {
  if (number >= x_.size())
    for (auto* column : {&x_, &y_, &radius_}) column->resize(number + 1);
  x_[number] = single(circle.center.x);
  y_[number] = single(circle.center.y);
  radius_[number] = single(circle.radius + single_margin(circle.center));
}

std::vector<std::uint32_t> Discs::near(const Cone& cone, double slack) const {
  std::vector<std::int32_t> marks(x_.size());
  mark(cone, slack, marks.data());
  std::vector<std::uint32_t> found;
  for (std::size_t i = 0; i < marks.size(); ++i)
    if (marks[i] != 0) found.push_back(static_cast<std::uint32_t>(i));
  return found;
}

void Discs::mark(const Cone& cone, double slack, std::int32_t* marks) const {
  const Vec2 left = rotated(cone.axis, cone.half_angle);
  const Vec2 right = rotated(cone.axis, -cone.half_angle);
  const float tx = single(cone.tip.x);
  const float ty = single(cone.tip.y);
  const float lx = single(left.x);
  const float ly = single(left.y);
  const float rx = single(right.x);
  const float ry = single(right.y);
  const float ax = single(cone.axis.x);
  const float ay = single(cone.axis.y);
  const float reach = single(cone.reach);
  const float wider = single(slack + single_margin(cone.tip));
  const float* const X = x_.data();
  const float* const Y = y_.data();
  const float* const R = radius_.data();
  const std::size_t count = x_.size();
  for (std::size_t i = 0; i < count; ++i) {
    const float x = X[i] - tx;
    const float y = Y[i] - ty;
    const float radius = R[i] + wider;
    const float along = ax * x + ay * y;
    // It lies beside no rim, and neither behind the tip nor beyond the end.
    marks[i] = (lx * y - ly * x <= radius) & (rx * y - ry * x >= -radius) & (along >= -radius) &
               (along <= reach + radius);
  }
}

}  // namespace orca::sim::detail
