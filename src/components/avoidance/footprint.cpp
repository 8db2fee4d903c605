// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/footprint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "orca/base/portable_math.hpp"

namespace orca::avoid {
namespace {

constexpr double kNoContact = std::numeric_limits<double>::infinity();
constexpr double kCentre = 1e-9;    // [m] A point nearer to the centre has no direction.
constexpr double kTouching = 1e-3;  // [m] left to an echo that is nearer than the margin.
constexpr double kStraight = 1e-6;  // [rad/s] a slower turn bends no arc by as much as a rounding error.

// The circle on which a point moves, clockwise, seen from a robot that turns to the left.
struct Orbit {
  Vec2 centre;
  Vec2 start;  // From the centre.

  // Returns the angle [rad] from the start to a place on the circle, in [0, 2 pi).
  [[nodiscard]] double angle_to(Vec2 place) const {
    const Vec2 end = place - centre;
    const double angle = portable::atan2(cross(end, start), dot(end, start));
    return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
  }
};

// Returns the way [m] straight ahead to the outline.
double straight_way(Vec2 point, const Footprint& body) {
  const bool round = body.is_circle();
  const double aside = std::abs(point.y);
  if (point.x <= 0.0 || aside >= (round ? body.radius : body.half_width)) return kNoContact;
  return point.x - (round ? std::sqrt(body.radius * body.radius - aside * aside) : body.half_length);
}

// The circles of orbit and outline meet in two places, mirrored at the line through their centres.
double angle_to_circle(const Orbit& orbit, double radius) {
  const double offset = orbit.centre.y;  // From the middle of the outline, along y.
  const double orbit_radius = norm(orbit.start);
  if (offset <= 0.0) return kNoContact;
  const double y = 0.5 * (radius * radius - orbit_radius * orbit_radius + offset * offset) / offset;
  const double square = radius * radius - y * y;
  if (square < 0.0) return kNoContact;
  const double x = std::sqrt(square);
  return std::min(orbit.angle_to({x, y}), orbit.angle_to({-x, y}));
}

double angle_to_rectangle(const Orbit& orbit, const Footprint& body) {
  const double square = dot(orbit.start, orbit.start);
  double nearest = kNoContact;
  const auto meet = [&](Vec2 place) { nearest = std::min(nearest, orbit.angle_to(place)); };
  const double across = square - body.half_length * body.half_length;
  if (across >= 0.0) {
    for (const double y : {orbit.centre.y - std::sqrt(across), orbit.centre.y + std::sqrt(across)}) {
      if (std::abs(y) > body.half_width) continue;
      meet({body.half_length, y});
      meet({-body.half_length, y});
    }
  }
  for (const double y : {-body.half_width, body.half_width}) {
    const double along = square - (y - orbit.centre.y) * (y - orbit.centre.y);
    if (along < 0.0 || along > body.half_length * body.half_length) continue;
    meet({std::sqrt(along), y});
    meet({-std::sqrt(along), y});
  }
  return nearest;
}

// Returns whether an echo comes from so far within the body that it can only be the robot itself, or an error.
bool is_within(double gap, const Footprint& body) {
  return gap <= -(body.is_circle() ? body.radius : std::min(body.half_length, body.half_width));
}

}  // namespace

double reach(const Footprint& body) {
  return body.is_circle() ? body.radius : portable::hypot(body.half_length, body.half_width);
}

Footprint grown(const Footprint& body, double margin) {
  if (body.is_circle()) return {.radius = body.radius + margin};
  return {body.half_length + margin, body.half_width + margin, body.radius + margin};
}

double gap(Vec2 point, const Footprint& body) {
  if (body.is_circle()) return norm(point) - body.radius;
  return std::max(std::abs(point.x) - body.half_length, std::abs(point.y) - body.half_width);
}

double gap_rate(Vec2 point, const Twist2& motion, const Footprint& body) {
  const Vec2 velocity{motion.turn_rate * point.y - motion.forward, -motion.turn_rate * point.x};
  if (body.is_circle()) return dot(point, velocity) / std::max(norm(point), kCentre);
  const bool beside = std::abs(point.y) - body.half_width > std::abs(point.x) - body.half_length;
  return beside ? std::copysign(1.0, point.y) * velocity.y : std::copysign(1.0, point.x) * velocity.x;
}

double time_to_touch(Vec2 point, const Twist2& motion, const Footprint& body) {
  const double rate = std::abs(motion.turn_rate);
  if (rate < kStraight) return motion.forward > 0.0 ? straight_way(point, body) / motion.forward : kNoContact;
  if (motion.turn_rate < 0.0) point.y = -point.y;  // A turn to the right is one to the left in a mirror.
  const Vec2 centre{0.0, motion.forward / rate};
  const Orbit orbit{centre, point - centre};
  const double angle =
      body.is_circle() ? angle_to_circle(orbit, body.radius) : angle_to_rectangle(orbit, body);
  return angle / rate;
}

double time_to_margin(Vec2 echo, const Twist2& motion, double margin, const Footprint& body) {
  const double there = gap(echo, body);
  if (there >= margin) return time_to_touch(echo, motion, grown(body, margin));
  if (is_within(there - kTouching, body)) return kNoContact;
  if (gap_rate(echo, motion, body) < 0.0) return 0.0;
  return time_to_touch(echo, motion, grown(body, there - kTouching));
}

double time_to_margin(std::span<const Vec2> echoes, const Twist2& motion, double margin,
                      const Footprint& body) {
  double time = kNoContact;
  for (const Vec2 echo : echoes) time = std::min(time, time_to_margin(echo, motion, margin, body));
  return time;
}

bool can_stop(const Twist2& motion, double time, const Brakes& brakes) {
  const double left = std::max(0.0, time);
  return motion.forward <= 2.0 * left * brakes.deceleration &&
         std::abs(motion.turn_rate) <= 2.0 * left * brakes.turn_deceleration;
}

}  // namespace orca::avoid
