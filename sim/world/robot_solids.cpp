// SPDX-License-Identifier: LGPL-3.0-or-later
#include "robot_solids.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "orca/sim/sections.hpp"

namespace orca::sim::detail {
namespace {

constexpr int kSlices = 16;  // Of a part that is not upright, besides the heights of sensors.

// Returns true if one round solid lies in another.
bool holds(const Body& outer, const Body& inner) {
  const auto* a = std::get_if<Circle>(&outer.shape);
  const auto* b = std::get_if<Circle>(&inner.shape);
  return a != nullptr && b != nullptr && norm(a->center - b->center) + b->radius <= a->radius &&
         outer.bottom <= inner.bottom && inner.top <= outer.top;
}

}  // namespace

RobotSolids::RobotSolids(const RobotModel& robot, const std::set<double>& eyes) {
  for (const Part& part : robot.parts) {
    const auto [bottom, top] = height_range_of(part);
    if (!is_upright(part)) {
      add_slices(part, eyes);
    } else if (bottom < top) {
      for (Shape& plan : sections_at({part}, bottom)) add({std::move(plan), bottom, top, kCasing});
    }
  }
  if (solids_.empty()) add({robot.footprint, robot.bottom, robot.top, kCasing});
}

// Each slice reaches half way to the heights of its neighbours.
void RobotSolids::add_slices(const Part& part, const std::set<double>& eyes) {
  const auto [bottom, top] = height_range_of(part);
  std::set<double> heights(eyes.lower_bound(bottom), eyes.lower_bound(top));
  for (int k = 0; k < kSlices; ++k) heights.insert(bottom + (k + 0.5) * (top - bottom) / kSlices);
  double from = bottom;
  for (auto it = heights.begin(); it != heights.end(); ++it) {
    const auto next = std::next(it);
    const double to = next == heights.end() ? top : 0.5 * (*it + *next);
    for (Shape& plan : sections_at({part}, *it)) add({std::move(plan), from, to, kCasing});
    from = to;
  }
}

// Leaves out round solids inside others, such as the shell of a robot beside its body.
void RobotSolids::add(Body solid) {
  if (std::ranges::any_of(solids_, [&](const Body& other) { return holds(other, solid); })) return;
  std::erase_if(solids_, [&](const Body& other) { return holds(solid, other); });
  solids_.push_back(std::move(solid));
}

std::vector<Body> RobotSolids::at(const Pose2& X_WB) const {
  std::vector<Body> there;
  there.reserve(solids_.size());
  for (const Body& solid : solids_)
    there.push_back({placed(solid.shape, X_WB), solid.bottom, solid.top, solid.colour});
  return there;
}

std::set<double> sensor_heights(const RobotModel& robot) {
  std::set<double> heights;
  for (const SonarRing& ring : robot.sonars)
    for (std::size_t k = 0; k < ring.count; ++k) heights.insert(ring.height_of(k));
  for (const LaserScanner& laser : robot.lasers) heights.insert(laser.height);
  for (const InfraredRing& ring : robot.infrareds) heights.insert(ring.height);
  return heights;
}

}  // namespace orca::sim::detail
