// SPDX-License-Identifier: LGPL-3.0-or-later
#include "passage.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "orca/base/portable_math.hpp"

namespace orca::doors {
namespace {

constexpr double kTurnRate = 0.8;    // [rad/s] at most
constexpr double kSteering = 1.5;    // [1/s]
constexpr double kOnAxis = 0.03;     // [m]
constexpr double kStraight = 0.035;  // [rad]

double limited(double rate) { return std::clamp(rate, -kTurnRate, kTurnRate); }

}  // namespace

std::optional<Gap> gap_in(std::span<const Vec2> points, double width) {
  constexpr double kDepth = 0.2;   // [m] before and behind its middle: wall, leaf and an error of the pose
  constexpr double kAside = 0.35;  // [m] of wall beside it
  constexpr double kOff = 0.3;     // [m] by which its middle may be elsewhere than on the map
  std::vector<double> across;
  for (const Vec2 point : points)
    if (std::fabs(point.x) <= kDepth && std::fabs(point.y) <= 0.5 * width + kAside) across.push_back(point.y);
  std::ranges::sort(across);
  std::optional<Gap> widest;
  for (std::size_t i = 1; i < across.size(); ++i) {
    const Gap gap{0.5 * (across[i - 1] + across[i]), across[i] - across[i - 1]};
    if (std::fabs(gap.middle) <= kOff && (!widest || gap.width > widest->width)) widest = gap;
  }
  return widest;
}

std::optional<Step> line_up(const Pose2& robot, double middle, double run_up, double speed) {
  constexpr double kTurnFirst = 0.2;  // [rad] off the way to its place, from which it turns on the spot
  const double off = robot.y - middle;
  const double near = 0.5 * run_up;  // Nearer to the door it cannot turn aside any more.
  if (std::fabs(off) <= kOnAxis && robot.x < -near) {
    const double yaw = wrapped(robot.yaw);
    if (std::fabs(yaw) <= kStraight) return std::nullopt;
    return Step{0.0, limited(-kSteering * yaw)};
  }
  // It crosses the axis at the place of its run-up.
  const Vec2 way = Vec2{-run_up, middle} - robot.position();
  const double bearing = wrapped(portable::atan2(way.y, way.x) - robot.yaw);
  if (std::fabs(bearing) > kTurnFirst) return Step{0.0, limited(kSteering * bearing)};
  return Step{std::min(speed, std::max(0.05, norm(way))), limited(kSteering * bearing)};
}

Step pass(const Pose2& robot, double middle, double speed) {
  constexpr double kLookAhead = 0.3;  // [m]
  const double bearing = wrapped(portable::atan2(middle - robot.y, kLookAhead) - robot.yaw);
  return {speed, limited(2.0 * speed * portable::sin(bearing) / kLookAhead)};
}

}  // namespace orca::doors
