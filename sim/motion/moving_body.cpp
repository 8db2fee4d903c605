// SPDX-License-Identifier: LGPL-3.0-or-later
#include "moving_body.hpp"

#include <algorithm>

#include "orca/sim/sections.hpp"

namespace orca::sim::detail {

double reach_of(const Rounded& plan) {
  double reach = 0.0;
  for (const Vec2& corner : plan.corners) reach = std::max(reach, norm(corner) + plan.radius);
  return reach;
}

RobotOutline::RobotOutline(std::vector<Part> parts) : parts_(std::move(parts)) {
  for (const Part& part : parts_) {
    const auto [bottom, top] = height_range_of(part);
    for (const Shape& plan : plans_between({part}, bottom, top))
      pieces_.push_back({solid_of(plan), bottom, top});
  }
  for (const Piece& piece : pieces_) reach_ = std::max(reach_, reach_of(piece.plan));
}

const std::vector<Rounded>& RobotOutline::between(double low, double high) {
  const auto [found, is_new] = plans_.try_emplace({low, high});
  if (is_new)
    for (const Shape& plan : plans_between(parts_, low, high)) found->second.push_back(solid_of(plan));
  return found->second;
}

}  // namespace orca::sim::detail
