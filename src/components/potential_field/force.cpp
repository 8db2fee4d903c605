// SPDX-License-Identifier: LGPL-3.0-or-later
#include "force.hpp"

#include <algorithm>
#include <numeric>

#include "orca/base/portable_math.hpp"

namespace orca::field {
namespace {

constexpr double kNearest = 0.01;  // [m] The field has a pole at the outline.

// Returns the point of the body that is nearest to an echo; the echo itself if it lies within.
Vec2 nearest_point(Vec2 echo, const Footprint& body) {
  if (body.is_circle()) return shortened(echo, body.radius);
  return {std::clamp(echo.x, -body.half_length, body.half_length),
          std::clamp(echo.y, -body.half_width, body.half_width)};
}

Vec2 unit(Vec2 vector) {
  const double length = norm(vector);
  return length > 0.0 ? (1.0 / length) * vector : Vec2{};
}

}  // namespace

Vec2 attraction(Vec2 goal, const Settings& settings) {
  return shortened(settings.attraction * goal, settings.damping * settings.max_speed);
}

Vec2 repulsion(Vec2 echo, const Settings& settings) {
  const Vec2 gap = echo - nearest_point(echo, settings.body);
  const double distance = norm(gap);
  if (distance >= settings.influence) return {};
  const Vec2 away = -1.0 * unit(distance > 0.0 ? gap : echo);
  const double rho = std::max(distance, kNearest);
  return (settings.repulsion * (1.0 / rho - 1.0 / settings.influence) / (rho * rho)) * away;
}

Vec2 repulsion(std::span<const Vec2> echoes, const Settings& settings) {
  return std::accumulate(echoes.begin(), echoes.end(), Vec2{},
                         [&](Vec2 sum, Vec2 echo) { return sum + repulsion(echo, settings); });
}

Vec2 velocity(Vec2 force, const Settings& settings) { return (1.0 / settings.damping) * force; }

Course course(Vec2 velocity, const Settings& settings) {
  return {portable::atan2(velocity.y, velocity.x), std::clamp(velocity.x, 0.0, settings.max_speed)};
}

}  // namespace orca::field
