// SPDX-License-Identifier: LGPL-3.0-or-later
#include "motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::nd {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kQuarter = 0.5 * kPi;

double bearing(Vec2 place) { return portable::atan2(place.y, place.x); }

// HSWR: the tangent to the circle around the edge that the robot must not enter.
double past(const Edge& edge, double clearance) {
  const double sine = clearance / std::max(norm(edge.place), clearance);
  return wrapped(bearing(edge.place) - edge.side * portable::asin(sine));
}

bool is_wide(const Region& region, double wide) { return static_cast<double>(region.width) * kSector > wide; }

// The direction of the situation with high safety.
double undisturbed(const FreeWalkingArea& area, double radius, const Settings& settings) {
  if (area.holds_goal()) return bearing(area.place);
  if (is_wide(area.region, settings.wide)) return past(*area.edge, radius + settings.security_distance);
  return area.region.middle();
}

// LS1 and LSGR: at the outline the robot turns its back on the danger, at the security distance it does nothing.
double turned_away(double direction, const Danger& danger) {
  return direction + (1.0 - danger.share) * wrapped(danger.direction + kPi - direction);
}

// LS2: the middle between the dangers, and from there on to the side where there is more room.
double between(const Danger& left, const Danger& right) {
  const double direction = std::clamp(
      wrapped(right.direction + 0.5 * wrapped(left.direction - right.direction)), -kQuarter, kQuarter);
  const double sum = left.share + right.share;
  const double off = sum > 0.0 ? (left.share - right.share) / sum : 0.0;
  return direction + off * (off > 0.0 ? kQuarter - direction : kQuarter + direction);
}

double speed_beside(double share, const Settings& settings) {
  return settings.max_speed * std::max(share, settings.least_share);
}

double nose(const Footprint& body) { return body.is_circle() ? body.radius : body.half_length; }

// Returns whether the robot can stop before an echo is nearer than the margin, and by `reserve` [m] of its way before that.
bool keeps(const Course& course, double reserve, std::span<const Vec2> echoes, const Settings& settings) {
  const Twist2 motion{course.speed, 0.0, course.turn_rate};
  const double time = avoid::time_to_margin(echoes, motion, settings.margin, settings.body);
  const double reserved = course.speed > 0.0 ? reserve / course.speed : 0.0;
  return can_stop(motion, time - settings.reaction - reserved, settings.brakes);
}

void note(std::optional<Danger>& nearest, const Danger& danger) {
  if (!nearest || danger.share < nearest->share) nearest = danger;
}

}  // namespace

double half_way(const Footprint& body) { return body.is_circle() ? body.radius : body.half_width; }

double Dangers::share() const { return std::min(left ? left->share : 1.0, right ? right->share : 1.0); }

Dangers dangers(std::span<const Vec2> echoes, double direction, const Settings& settings) {
  Dangers found;
  for (const Vec2 echo : echoes) {
    const double share = std::max(0.0, clearance(settings.body, echo)) / settings.security_distance;
    if (share >= 1.0) continue;
    const Danger danger{bearing(echo), share};
    const double off = wrapped(danger.direction - direction);
    if (std::abs(off) <= kQuarter) note(off >= 0.0 ? found.left : found.right, danger);
  }
  return found;
}

Situation situation(const Dangers& dangers, const FreeWalkingArea& area, double wide) {
  if (dangers.left && dangers.right) return Situation::low_safety_2_sides;
  const bool low = dangers.left || dangers.right;
  if (area.holds_goal())
    return low ? Situation::low_safety_goal_in_region : Situation::high_safety_goal_in_region;
  if (low) return Situation::low_safety_1_side;
  return is_wide(area.region, wide) ? Situation::high_safety_wide_region
                                    : Situation::high_safety_narrow_region;
}

double motion_direction(const Dangers& dangers, const FreeWalkingArea& area, double radius,
                        const Settings& settings) {
  double direction = 0.0;
  switch (situation(dangers, area, settings.wide)) {
    case Situation::low_safety_2_sides: direction = between(*dangers.left, *dangers.right); break;
    case Situation::low_safety_1_side:
    case Situation::low_safety_goal_in_region:
      direction =
          turned_away(undisturbed(area, radius, settings), dangers.left ? *dangers.left : *dangers.right);
      break;
    case Situation::high_safety_goal_in_region:
    case Situation::high_safety_wide_region:
    case Situation::high_safety_narrow_region: direction = undisturbed(area, radius, settings); break;
  }
  return std::clamp(direction, -kQuarter, kQuarter);
}

Course course(double direction, double share, const Settings& settings) {
  const double turned = direction / kQuarter;
  return {speed_beside(share, settings) * (1.0 - std::abs(turned)), settings.max_turn_rate * turned};
}

bool is_safe(const Course& course, std::span<const Vec2> echoes, const Settings& settings) {
  return keeps(course, 0.0, echoes, settings);
}

Course made_safe(const Course& wanted, double share, double turn_rate, std::span<const Vec2> echoes,
                 const Settings& settings) {
  const bool may_turn = is_safe({0.0, wanted.turn_rate}, echoes, settings);
  const double speed = may_turn ? wanted.speed : speed_beside(share, settings);
  const double to_turn = avoid::reach(settings.body) - nose(settings.body);
  for (const double turning : {1.0, 0.5, 0.0}) {
    for (const double driving : {1.0, 0.75, 0.5, 0.25, 0.0}) {
      const Course slower{driving * speed, turning * wanted.turn_rate};
      const bool keeps_now = driving == 0.0 || keeps({slower.speed, turn_rate}, to_turn, echoes, settings);
      if (keeps_now && keeps(slower, to_turn, echoes, settings)) return slower;
    }
  }
  return {};
}

double speed_to_stop(double way, const Settings& settings) {
  return std::sqrt(2.0 * settings.brakes.deceleration * std::max(0.0, way));
}

}  // namespace orca::nd
