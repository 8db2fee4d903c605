// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/pure_pursuit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca::nav {
namespace {

constexpr std::array kShares{1.0, 0.75, 0.55, 0.4, 0.28};  // of the look-ahead
constexpr double kShortestLook = 0.15;                     // [m]
constexpr double kStep = 0.05;                             // [m] at which arcs are looked at
constexpr double kTurnStep = 0.1;                          // [rad] at which turns are looked at
constexpr double kTurnMargin =
    0.02;  // [m] kept free while turning: corners are fast, and places of echoes err by 1 cm
constexpr double kTurnGain = 3.0;         // [1/s] turn rate per angle left
constexpr double kLeastTurnRate = 0.2;    // [rad/s]
constexpr double kSqueezeMargin = 0.005;  // [m] kept free where the margin finds no way,
constexpr double kSqueezeSpeed = 0.5;     // at that share of the narrow speed
constexpr double kCreep = 0.06;           // [m/s] Below this it counts as standing.
constexpr double kAlmostThere = 0.05;     // [m] left of an arc that need not be free
constexpr double kBendPiece = 0.3;        // [m] of the path over which a bend is measured
constexpr double kStraight = 1e-3;        // [1/m]

struct Choice {
  Arc arc;
  double free = -1.0;      // [m] of the arc and what comes behind it
  double seen = 0.0;       // [m] of them that was looked at
  double clearance = 0.0;  // [m] on the way there
  double look = 0.0;       // [m]
};

Vec2 carrot(const Path& path, double along, const Pose2& pose) { return seen_from(pose, path.at(along)); }

Choice try_arc(Vec2 target, double look, double horizon, const Scene& scene, const Footprint& footprint,
               double margin, double turning_radius) {
  Arc arc = arc_to(target);
  if (turning_radius > 0.0)
    arc.curvature = std::clamp(arc.curvature, -1.0 / turning_radius, 1.0 / turning_radius);
  const double length = std::max(arc.length, horizon);
  const int steps = std::max(1, static_cast<int>(std::ceil(length / kStep)));
  const Room room =
      room_along(footprint, scene.pose, {length, 0.0, length * arc.curvature}, steps, scene.points, margin);
  return {arc, room.share * length, length, room.clearance, look};
}

// Returns the arc with the longest look-ahead that is free; if none is, that with the longest free part.
Choice choose(const Path& path, double along, const Scene& scene, const Footprint& footprint,
              const Pursuit& pursuit) {
  const double reach = look_ahead(scene.speed, pursuit);
  const double stop =
      std::fabs(scene.speed) * pursuit.delay + 0.5 * scene.speed * scene.speed / pursuit.deceleration;
  Choice best;
  for (const double margin : {pursuit.margin, kSqueezeMargin})
    for (const double share : kShares) {
      const double look = std::max(share * reach, kShortestLook);
      const Vec2 target = carrot(path, std::min(along + look, path.length()), scene.pose);
      if (norm(target) < 1e-3) continue;
      const Choice choice =
          try_arc(target, look, stop + kStep, scene, footprint, margin, pursuit.turning_radius);
      if (choice.free > best.free) best = choice;
      if (choice.free >= choice.arc.length - kAlmostThere) return choice;
    }
  return best;
}

// Returns the largest speed from which it slows down in time for the bends of the path that come.
double speed_before_bends(const Path& path, double along, const Pursuit& pursuit) {
  double speed = pursuit.max_speed;
  const double most =
      std::min(path.length() - along, speed * pursuit.delay + 0.5 * speed * speed / pursuit.deceleration);
  for (double ahead = 0.0; speed > kBendSpeed && ahead < most; ahead += kBendPiece) {
    const double bend =
        std::fabs(wrapped(path.heading(along + ahead + kBendPiece) - path.heading(along + ahead))) /
        kBendPiece;
    if (bend < kStraight) continue;
    const double there = std::min(std::sqrt(pursuit.lateral_acceleration / bend), pursuit.turn_rate / bend);
    const double slowed = speed_to_stop_within(ahead, pursuit.deceleration, pursuit.delay);
    speed = std::min(speed, norm({std::max(there, kBendSpeed), slowed}));
  }
  return speed;
}

double regulated_speed(const Choice& choice, double left, const Pursuit& pursuit, double last_speed) {
  const double bend = std::fabs(choice.arc.curvature);
  double speed = pursuit.max_speed;
  if (bend > 0.0)
    speed = std::min({speed, std::sqrt(pursuit.lateral_acceleration / bend), pursuit.turn_rate / bend});
  const double beside = std::max(0.0, choice.clearance - pursuit.margin);
  speed = std::min(speed, pursuit.narrow_speed + pursuit.speed_per_clearance * beside);
  if (choice.clearance < pursuit.margin) speed = std::min(speed, kSqueezeSpeed * pursuit.narrow_speed);
  // A short look-ahead was chosen because a longer one was not free: it needs time to steer.
  speed = std::min(speed, std::max(pursuit.narrow_speed, choice.look / (0.5 * pursuit.look_ahead_time)));
  if (choice.free < choice.seen)
    speed = std::min(speed, speed_to_stop_within(choice.free, pursuit.deceleration, pursuit.delay));
  const double end = speed_to_stop_within(left, pursuit.deceleration, 0.0);
  // Behind its end another path may lead anywhere.
  return std::min(speed, norm({end, std::min(last_speed, kBendSpeed)}));
}

bool may_turn(double angle, const Scene& scene, const Footprint& footprint) {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(angle) / kTurnStep)));
  return room_along(footprint, scene.pose, {0.0, 0.0, angle}, steps, scene.points, kTurnMargin).share >= 1.0;
}

}  // namespace

Arc arc_to(Vec2 point) {
  const double squared = dot(point, point);
  const double distance = std::sqrt(squared);
  const double curvature = 2.0 * point.y / squared;
  // The arc turns by twice the angle to the point.
  const double half = portable::atan2(std::fabs(point.y), point.x);
  return {curvature, half < 1e-6 ? distance : distance * half / portable::sin(half)};
}

double look_ahead(double speed, const Pursuit& pursuit) {
  return std::clamp(std::fabs(speed) * pursuit.look_ahead_time, pursuit.min_look_ahead,
                    pursuit.max_look_ahead);
}

double speed_to_stop_within(double way, double deceleration, double delay) {
  if (way <= 0.0) return 0.0;
  const double lost = deceleration * delay;
  return std::sqrt(lost * lost + 2.0 * deceleration * way) - lost;
}

// The longer way round is not tried: a rectangle that turns by more than half a circle sweeps all that its corners reach. Only the
// steps at which a turn is looked at could make it seem free.
Steer turn_on_the_spot(double angle, const Scene& scene, const Footprint& footprint, const Pursuit& pursuit) {
  if (!may_turn(angle, scene, footprint)) return {.turning = true, .blocked = true};
  const double rate = std::clamp(kTurnGain * std::fabs(angle), kLeastTurnRate, pursuit.turn_rate);
  return {0.0, std::copysign(rate, angle), true, false};
}

Steer follow(const Path& path, double along, const Scene& scene, const Footprint& footprint,
             const Pursuit& pursuit, double last_speed) {
  const double near = std::min(along + pursuit.min_look_ahead, path.length());
  const Vec2 ahead = carrot(path, near, scene.pose);
  const double off = norm(ahead) > 1e-3 ? portable::atan2(ahead.y, ahead.x) : 0.0;
  const bool can_turn = pursuit.turning_radius <= 0.0;
  if (can_turn && std::fabs(off) > (scene.turning ? pursuit.turned : pursuit.turn_in_place)) {
    const Steer steer = turn_on_the_spot(off, scene, footprint, pursuit);
    if (!steer.blocked || std::fabs(off) > pursuit.turn_in_place) return steer;
  }
  const Choice choice = choose(path, along, scene, footprint, pursuit);
  const double speed = std::min(regulated_speed(choice, path.length() - along, pursuit, last_speed),
                                speed_before_bends(path, along, pursuit));
  if (speed >= kCreep || choice.free >= choice.arc.length - kAlmostThere)
    return {speed, std::clamp(speed * choice.arc.curvature, -pursuit.turn_rate, pursuit.turn_rate), false,
            false};
  if (!can_turn || std::fabs(off) < 0.5 * pursuit.turned) return {.blocked = true};
  return turn_on_the_spot(off, scene, footprint, pursuit);
}

}  // namespace orca::nav
