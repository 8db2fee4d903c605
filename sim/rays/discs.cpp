// SPDX-License-Identifier: LGPL-3.0-or-later
#include "discs.hpp"

#include <algorithm>
#include <array>

#include "marks.hpp"
#include "single_precision.hpp"

namespace orca::sim::detail {
namespace {

// Number of circles that are marked at a time.
constexpr std::size_t kBlock = 64;
static_assert(kBlock % kMarkGroup == 0);

}  // namespace

void Discs::set(std::size_t number, const Circle& circle) {
  if (number >= x_.size())
    for (auto* column : {&x_, &y_, &radius_}) column->resize(number + 1);
  x_[number] = single(circle.center.x);
  y_[number] = single(circle.center.y);
  radius_[number] = single(circle.radius + single_margin(circle.center));
}

void Discs::find_near(const Cone& cone, std::vector<std::uint32_t>& found) const {
  const Question asked(cone);
  std::array<std::int32_t, kBlock> marks;
  for (std::size_t first = 0; first < x_.size(); first += kBlock) {
    const std::size_t count = std::min(kBlock, x_.size() - first);
    mark(asked, first, count, marks.data());
    for_all_marked(marks.data(), count,
                   [&](std::size_t i) { found.push_back(static_cast<std::uint32_t>(first + i)); });
  }
}

Discs::Question::Question(const Cone& cone) {
  tip_x = single(cone.tip.x);
  tip_y = single(cone.tip.y);
  left_x = single(cone.left.x);
  left_y = single(cone.left.y);
  right_x = single(cone.right.x);
  right_y = single(cone.right.y);
  axis_x = single(cone.axis.x);
  axis_y = single(cone.axis.y);
  reach = single(cone.reach);
  wider = single(cone.slack + single_margin(cone.tip));
}

void Discs::mark(const Question& asked, std::size_t first, std::size_t count, std::int32_t* marks) const {
  const Question one = asked;
  const float* const X = x_.data() + first;
  const float* const Y = y_.data() + first;
  const float* const R = radius_.data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = X[i] - one.tip_x;
    const float y = Y[i] - one.tip_y;
    const float radius = R[i] + one.wider;
    const float along = one.axis_x * x + one.axis_y * y;
    // The circle lies outside neither rim, and neither behind the tip nor beyond the end.
    marks[i] = (one.left_x * y - one.left_y * x <= radius) & (one.right_x * y - one.right_y * x >= -radius) &
               (along >= -radius) & (along <= one.reach + radius);
  }
}

}  // namespace orca::sim::detail
