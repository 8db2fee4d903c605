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
constexpr double kSqueezePenalty = 0.3;          // [rad] for a way where only the body fits
constexpr double kOtherSidePenalty = 0.8;        // [rad] for changing the side once chosen
constexpr double kGoalShare = 0.8;               // of the angle off the goal; the rest: off the robot's axis
constexpr double kBlockedPenalty = 4.0;          // [rad] for no free way at all: more than any turn costs

constexpr double kTurnUrgency = 0.95;  // of not turning where a corner would touch something

constexpr double kNarrow = 0.45;  // [m] across a thing that stands alone, and may be wider elsewhere
constexpr double kNear = 0.8;     // [m] around it, where nothing else is

constexpr double kNever = std::numeric_limits<double>::infinity();

// A body that squeezes has a round nose that much farther ahead: a rectangle would fit between two posts only if
// it points exactly that way.
double way_to_point(Vec2 echo, Vec2 ahead, const Limits& limits) {
  const bool squeezes = limits.squeezes && limits.body;
  const double reach = (squeezes ? limits.body->half_width : limits.robot_radius) + limits.margin;
  const double nose = squeezes ? limits.body->half_length - limits.body->half_width : 0.0;
  const double along = dot(ahead, echo);
  const double aside = std::abs(cross(ahead, echo));
  return along <= 0.0 || aside >= reach ? kNever : along - nose - std::sqrt(reach * reach - aside * aside);
}

// Returns the angle in [0, 2 pi).
double angle_up(double angle) {
  const double within = wrapped(angle);
  return within < 0.0 ? within + 2.0 * std::numbers::pi : within;
}

double way_to_wall(Vec2 echo, Vec2 ahead, const Limits& limits) {
  const double distance = norm(echo);
  const double gap = distance - limits.robot_radius;
  if (gap >= limits.side_distance) return kNever;
  const double closing = distance > 0.0 ? dot(ahead, echo) / distance : 1.0;
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

struct Way {
  double direction;  // [rad]
  double cost;       // [rad]
};

Way best_direction(std::span<const Vec2> echoes, const TurnRoom& turns, const Situation& situation,
                   const Limits& limits) {
  Way best{0.0, cost(0.0, free_way(echoes, 0.0, limits), situation, limits)};
  for (int i = 1; i <= kSteps; ++i) {
    for (const double direction : {kStep * i, -kStep * i}) {
      if (!turns.allows(direction)) continue;
      const double c = cost(direction, free_way(echoes, direction, limits), situation, limits);
      if (c < best.cost) best = {direction, c};
    }
  }
  return best;
}

// Returns how far an echo lets the rectangle turn. Seen from the body the echo goes round on a circle, which lies within the rectangle
// near its corners: of a corner at the front from `low` to `high`. From an echo that is within already the
// corner can only turn away.
TurnRoom room_beside(Vec2 echo, double distance, const Rectangle& body) {
  const double low = distance > body.half_length ? portable::acos(body.half_length / distance) : 0.0;
  const double high =
      distance > body.half_width ? portable::asin(body.half_width / distance) : 0.5 * std::numbers::pi;
  const double bearing = portable::atan2(echo.y, echo.x);
  constexpr double kHalfTurn = std::numbers::pi;
  TurnRoom room;
  for (const double end : {high, -low, kHalfTurn - low, high - kHalfTurn})
    room.left = std::min(room.left, angle_up(bearing - end));
  for (const double end : {low, -high, kHalfTurn - high, low - kHalfTurn})
    room.right = std::min(room.right, angle_up(end - bearing));
  if (std::abs(echo.x) >= body.half_length || std::abs(echo.y) >= body.half_width) return room;
  const double corner =
      portable::atan2(std::copysign(body.half_width, echo.y), std::copysign(body.half_length, echo.x));
  (wrapped(bearing - corner) > 0.0 ? room.left : room.right) = 0.0;
  return room;
}

// Returns whether nothing near an echo is farther from it than a narrow thing is wide.
bool is_alone(Vec2 echo, std::span<const Vec2> echoes) {
  return std::ranges::none_of(echoes, [&](Vec2 other) {
    const double apart = norm(other - echo);
    return apart > kNarrow && apart < kNear;
  });
}

// Returns whether an echo and all those of the same thing are alone: else it is the middle of something wider.
bool is_narrow(Vec2 echo, std::span<const Vec2> echoes) {
  return std::ranges::all_of(
      echoes, [&](Vec2 other) { return norm(other - echo) > kNarrow || is_alone(other, echoes); });
}

}  // namespace

std::optional<Rectangle> rectangle(double length, double width) {
  if (length <= 0.0 || width <= 0.0) return std::nullopt;
  return Rectangle{0.5 * length, 0.5 * width};
}

double braking_way(double speed, double reaction, double acceleration) {
  return acceleration <= 0.0 ? 0.0 : speed * reaction + 0.5 * speed * speed / acceleration;
}

TurnRoom turn_room(std::span<const Vec2> echoes, const Situation& situation, const Limits& limits) {
  TurnRoom room;
  if (!limits.body) return room;
  const Rectangle wide{limits.body->half_length + limits.turn_margin,
                       limits.body->half_width + limits.turn_margin};
  // The circle that holds the robot cuts the corners.
  const double reach =
      std::min(portable::hypot(wide.half_length, wide.half_width), limits.robot_radius + limits.turn_margin);
  for (const Vec2 echo : echoes) {
    const double distance = portable::hypot(echo.x, echo.y);
    if (distance >= reach) continue;
    const TurnRoom beside = room_beside(echo, distance, wide);
    room = {std::min(room.left, beside.left), std::min(room.right, beside.right)};
  }
  return {std::max(0.0, room.left - std::max(0.0, situation.turning)),
          std::max(0.0, room.right - std::max(0.0, -situation.turning))};
}

double free_way(std::span<const Vec2> echoes, double direction, const Limits& limits) {
  double way = limits.safe_distance;
  const Vec2 ahead = orca::direction(direction);
  for (Vec2 echo : echoes)
    way = std::min({way, way_to_point(echo, ahead, limits), way_to_wall(echo, ahead, limits)});
  return std::max(0.0, way);
}

void add_feet(std::vector<Vec2>& all, double foot) {
  const std::size_t seen = all.size();
  for (std::size_t i = 0; i < seen; ++i) {
    const Vec2 echo = all[i];
    const double distance = norm(echo);
    if (distance <= 0.0 || !is_narrow(echo, std::span(all).first(seen))) continue;
    const Vec2 aside = foot / distance * Vec2{-echo.y, echo.x};
    all.push_back(echo + aside);
    all.push_back(echo - aside);
  }
}

double way_ahead(std::span<const Vec2> echoes, const Situation& situation, const Limits& limits) {
  return std::min(free_way(echoes, 0.0, limits), free_way(echoes, situation.turning, limits));
}

double way_to_goal(std::span<const Vec2> echoes, const Situation& situation, const Limits& limits) {
  if (!situation.goal) return limits.safe_distance;
  const double way = free_way(echoes, *situation.goal, limits);
  return way < situation.goal_distance ? way : limits.safe_distance;
}

bool should_squeeze(std::span<const Vec2> echoes, const Situation& situation, Limits limits) {
  const TurnRoom turns = turn_room(echoes, situation, limits);
  limits.squeezes = false;
  const double wide = best_direction(echoes, turns, situation, limits).cost;
  limits.squeezes = true;
  return best_direction(echoes, turns, situation, limits).cost + kSqueezePenalty < wide;
}

double room(double way, const Limits& limits) {
  const double span = limits.safe_distance - limits.stop_distance;
  return std::clamp((way - limits.stop_distance) / span, 0.0, 1.0);
}

double urgency(double way, bool may_turn, const Limits& limits) {
  return std::max(1.0 - room(way, limits), may_turn ? 0.0 : kTurnUrgency);
}

namespace {

// Advises a robot that slides as one that looks where it wants to go.
Advice avoid_sliding(std::span<const Vec2> echoes, const Situation& situation, Limits limits) {
  const double axis = situation.goal.value_or(situation.course.value_or(0.0));
  std::vector<Vec2> around;
  for (const Vec2 echo : echoes) around.push_back(rotated(echo, -axis));
  Situation turned = situation;
  if (turned.goal) turned.goal = 0.0;
  turned.turning = wrapped(situation.course.value_or(axis) - axis);
  if (situation.last_direction != 0.0) turned.last_direction = wrapped(situation.last_direction - axis);
  limits.slides = false;
  limits.body.reset();
  Advice advised = avoid(around, turned, limits);
  if (!advised.needed) return {};
  advised.speed = limits.max_speed * room(free_way(around, advised.direction, limits), limits);
  advised.direction = wrapped(advised.direction + axis);
  advised.slides = true;
  return advised;
}

}  // namespace

Advice avoid(std::span<const Vec2> echoes, const Situation& situation, const Limits& limits) {
  if (limits.slides) return avoid_sliding(echoes, situation, limits);
  const double ahead = way_ahead(echoes, situation, limits);
  const TurnRoom turns = turn_room(echoes, situation, limits);
  const bool may_turn = turns.allows(situation.goal.value_or(0.0));
  const double shortest =
      limits.watches_goal ? std::min(ahead, way_to_goal(echoes, situation, limits)) : ahead;
  if (shortest >= limits.safe_distance && may_turn) return {};
  return {true, best_direction(echoes, turns, situation, limits).direction,
          limits.max_speed * room(ahead, limits), urgency(shortest, may_turn, limits)};
}

}  // namespace orca::avoid
