// SPDX-License-Identifier: LGPL-3.0-or-later
#include "encounter.hpp"

#include <algorithm>
#include <cmath>

namespace orca::sim::detail {
namespace {

constexpr double kLeastAdvance = 1e-5;  // [m] A gap is not resolved finer.
constexpr double kNotClosing = 1e-7;    // [m/s] What the solver leaves.

// Returns how far the centres of the roundings are from the origin: what is round about it does not move by turning.
double arm_of(const Rounded& plan) {
  double arm = 0.0;
  for (const Vec2& corner : plan.corners) arm = std::max(arm, norm(corner));
  return arm;
}

Rounded seen_from(const Pose2& X_WR, const Pose2& X_WO, const Rounded& plan) {
  Rounded seen;
  place(plan, inverse(X_WR) * X_WO, seen);
  return seen;
}

}  // namespace

Gap Encounter::gap(double seconds) const {
  return gap_between(
      *plan, seen_from(one->at(seconds), other != nullptr ? other->at(seconds) : Pose2{}, other_plan));
}

void Encounter::add_touches(double limit, std::vector<Gap>& found) const {
  detail::add_touches(*plan, seen_from(one->pose, other != nullptr ? other->pose : Pose2{}, other_plan),
                      limit, found);
}

double Encounter::closing_speed(const Gap& gap, double seconds) const {
  const Vec2 normal = rotated(gap.normal, one->at(seconds).yaw);
  const Vec2 apart = other == nullptr ? one->velocity : one->velocity - other->velocity;
  double speed = -dot(normal, apart) + std::fabs(one->turn) * arm_of(*plan);
  if (other != nullptr) speed += std::fabs(other->turn) * arm_of(other_plan);
  return speed;
}

double Encounter::time_of_gap(double target, double seconds) const {
  double time = 0.0;
  Gap now = gap(time);
  while (time < seconds) {
    const double speed = closing_speed(now, time);
    if (speed <= kNotClosing) return seconds;
    const double slack = now.distance - target;
    const double next = time + std::max(slack, kLeastAdvance) / speed;
    if (next >= seconds) {
      const bool is_far = slack > kLeastAdvance;
      return is_far || gap(seconds).distance >= std::min(target, now.distance) ? seconds : time;
    }
    const Gap then = gap(next);
    if (slack <= kLeastAdvance && then.distance < std::min(target, now.distance)) return time;
    time = next;
    now = then;
  }
  return seconds;
}

}  // namespace orca::sim::detail
