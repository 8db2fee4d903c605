// SPDX-License-Identifier: LGPL-3.0-or-later
#include "wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/angle.hpp"

namespace orca::wall {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFine = kPi / 180.0;  // [rad] between two directions that are tried
constexpr double kSight = 1.0;         // [m] beyond the distance to keep, in which a wall is looked for
constexpr double kAhead = kPi / 6;  // [rad] across the axis up to which a thing counts as on the wall's side,
constexpr double kBehind = 5 * kPi / 6;  // [rad] the same behind
constexpr double kTouching = 1e-3;       // [m] A nearer thing has no direction.
constexpr double kBeside = 0.3;          // [rad] and
constexpr double kNear = 0.1;            // [m] between echoes of the same place
constexpr double kSharp = 1.0;           // [rad] of a turn that is made on the spot

// An echo, with the wall on the left.
struct Echo {
  double bearing;   // [rad]
  double distance;  // [m]
};

// Returns the echoes that a step can reach.
std::vector<Echo> seen_from_left(std::span<const Vec2> echoes, const Limits& limits) {
  const double mirror = limits.side == Side::left ? 1.0 : -1.0;
  const double farthest = limits.radius + limits.distance + std::max(kStep, kSight);
  std::vector<Echo> seen;
  for (const Vec2 echo : echoes)
    if (const double distance = norm(echo); distance < farthest)
      seen.push_back({portable::atan2(mirror * echo.y, echo.x), distance});
  return seen;
}

// The directions in which the circle touches a thing at the end of a step. The nearest one counts as a wall across its beam.
class Blocked {
 public:
  Blocked(const std::vector<Echo>& echoes, const Echo& nearest, double radius) {
    add(nearest, (nearest.distance - radius) / kStep);
    for (const Echo& echo : echoes)
      add(echo, (echo.distance * echo.distance + kStep * kStep - radius * radius) /
                    (2.0 * kStep * std::max(echo.distance, kTouching)));
  }
  [[nodiscard]] bool has(double direction) const {
    return std::ranges::any_of(
        sectors_, [&](const Sector& s) { return std::abs(wrapped(direction - s.middle)) < s.half; });
  }

 private:
  struct Sector {
    double middle;  // [rad]
    double half;    // [rad]
  };
  // @param cosine  of the angle off the thing at which the circle just passes it.
  void add(const Echo& echo, double cosine) {
    if (cosine < 1.0) sectors_.push_back({echo.bearing, portable::acos(std::max(-1.0, cosine))});
  }

  std::vector<Sector> sectors_;
};

// Returns the middle of the echoes that are as near as the nearest one: the least of many measurements is too near.
Echo middle_around(const Echo& nearest, const std::vector<Echo>& echoes) {
  double count = 0.0;
  Echo sum{0.0, 0.0};
  for (const Echo& echo : echoes) {
    const double aside = wrapped(echo.bearing - nearest.bearing);
    if (std::abs(aside) > kBeside || echo.distance > nearest.distance + kNear) continue;
    count += 1.0;
    sum = {sum.bearing + aside, sum.distance + echo.distance};
  }
  return {nearest.bearing + sum.bearing / count, sum.distance / count};
}

std::optional<double> along_wall(const std::vector<Echo>& echoes, const Echo& nearest, double radius) {
  const Blocked blocked(echoes, nearest, radius);
  for (double turned = 0.0; turned < 2.0 * kPi; turned += kFine)
    if (const double direction = wrapped(nearest.bearing - turned); !blocked.has(direction)) return direction;
  return std::nullopt;
}

std::optional<double> through(const std::vector<Echo>& echoes, const Echo& nearest, double radius) {
  const Blocked blocked(echoes, nearest, radius);
  for (double off = 0.0; off < 0.5 * kPi; off += kFine)
    for (const double direction : {-off, off})
      if (!blocked.has(direction)) return direction;
  return std::nullopt;
}

// Returns the motion in a direction: slower the more it turns.
Step towards(double direction, const Limits& limits) {
  if (std::abs(direction) > kSharp) return {direction, 0.0, true};
  return {direction, limits.max_speed * portable::cos(direction * 0.5 * kPi / kSharp), true};
}

}  // namespace

Step step_along(std::span<const Vec2> echoes, const Limits& limits) {
  const std::vector<Echo> seen = seen_from_left(echoes, limits);
  const auto off_side = [](const Echo& echo) {
    return echo.bearing < -kAhead && echo.bearing > -kBehind ? std::numeric_limits<double>::infinity()
                                                             : echo.distance;
  };
  const auto nearest = std::ranges::min_element(seen, {}, off_side);
  if (nearest == seen.end() || !std::isfinite(off_side(*nearest))) return {0.0, limits.max_speed, false};
  const Echo wall = middle_around(*nearest, seen);
  auto direction = along_wall(seen, wall, limits.radius + limits.distance);
  if (!direction) direction = through(seen, wall, limits.radius + limits.least);
  Step step = towards(direction.value_or(-0.5 * kPi), limits);
  if (limits.side == Side::right) step.direction = -step.direction;
  return step;
}

}  // namespace orca::wall
