// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/advice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "orca/base/portable_math.hpp"

namespace orca::avoid {
namespace {

constexpr double kStep = std::numbers::pi / 36;  // candidate directions every 5 degrees
constexpr int kSteps = 36;                       // up to half a turn to either side
constexpr double kOtherSidePenalty = 0.8;        // [rad] for changing the side once chosen
constexpr double kGoalShare = 0.8;               // of the angle off the goal; the rest: off the robot's axis
constexpr double kBlockedPenalty = 4.0;          // [rad] for no free way at all: more than any turn costs

constexpr double kNever = std::numeric_limits<double>::infinity();

double way_to_point(Vec2 echo, double direction, const Limits& limits) {
  const double reach = limits.robot_radius + limits.margin;
  const auto [cosine, sine] = portable::cos_sin(direction);
  const double along = cosine * echo.x + sine * echo.y;
  const double aside = std::abs(cosine * echo.y - sine * echo.x);
  return along <= 0.0 || aside >= reach ? kNever : along - std::sqrt(reach * reach - aside * aside);
}

double way_to_wall(Vec2 echo, double direction, const Limits& limits) {
  const double gap = portable::hypot(echo.x, echo.y) - limits.robot_radius;
  if (gap >= limits.side_distance) return kNever;
  const double closing = portable::cos(direction - portable::atan2(echo.y, echo.x));
  return closing < 0.05 ? kNever : (gap - limits.margin) / closing;
}

// Returns the cost of a direction: for missing the goal, turning far, changing sides, and a short way.
double cost(double direction, double way, const Situation& situation, const Limits& limits) {
  const double goal = situation.goal.value_or(0.0);
  const double off = wrapped(direction - goal);
  const bool changes_side = situation.last_direction * direction < 0.0;
  const double missing = std::max(0.0, limits.safe_distance - way) / limits.safe_distance;
  return kGoalShare * std::abs(off) + (1.0 - kGoalShare) * std::abs(direction) +
         (changes_side ? kOtherSidePenalty : 0.0) + kBlockedPenalty * missing;
}

double best_direction(std::span<const Vec2> echoes, const Situation& situation, const Limits& limits) {
  double best = 0.0;
  double lowest = cost(0.0, free_way(echoes, 0.0, limits), situation, limits);
  for (int i = 1; i <= kSteps; ++i) {
    for (const double direction : {kStep * i, -kStep * i}) {
      const double c = cost(direction, free_way(echoes, direction, limits), situation, limits);
      if (c < lowest) {
        lowest = c;
        best = direction;
      }
    }
  }
  return best;
}

}  // namespace

double free_way(std::span<const Vec2> echoes, double direction, const Limits& limits) {
  double way = limits.safe_distance;
  for (Vec2 echo : echoes)
    way = std::min({way, way_to_point(echo, direction, limits), way_to_wall(echo, direction, limits)});
  return std::max(0.0, way);
}

double way_ahead(std::span<const Vec2> echoes, const Situation& situation, const Limits& limits) {
  return std::min(free_way(echoes, 0.0, limits), free_way(echoes, situation.turning, limits));
}

double room(double way, const Limits& limits) {
  const double span = limits.safe_distance - limits.stop_distance;
  return std::clamp((way - limits.stop_distance) / span, 0.0, 1.0);
}

Advice avoid(std::span<const Vec2> echoes, const Situation& situation, const Limits& limits) {
  const double ahead = way_ahead(echoes, situation, limits);
  if (ahead >= limits.safe_distance) return {};
  const double left = room(ahead, limits);
  return {true, best_direction(echoes, situation, limits), limits.max_speed * left, 1.0 - left};
}

}  // namespace orca::avoid
