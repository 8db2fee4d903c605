// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "angles.hpp"
#include "orca/geometry/vec2.hpp"

namespace orca::sim::test {

/// A straight or a round upright face as a sensor sees it that is at the origin and looks along x. Its closed forms
/// share no code with the simulator's.
struct UprightFace {
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  Vec2 a, b;  ///< The ends; the solid is to the left of the way from a to b. A round one has its centre in a.
  double radius = -1.0;  ///< [m] Negative: straight.
  double bottom = 0.0;   ///< [m] Above the sensor's height, negative if below it.
  double top = 0.0;      ///< [m] Above the sensor's height, negative if below it.

  [[nodiscard]] bool is_round() const { return radius >= 0.0; }
  [[nodiscard]] bool at_height() const { return bottom <= 0.0 && top > 0.0; }
  /// Returns the height that is nearest to the sensor's, above that [m].
  [[nodiscard]] double rise() const { return bottom > 0.0 ? bottom : std::min(top, 0.0); }
  [[nodiscard]] bool is_above() const { return bottom > 0.0; }

  /// Returns the distance [m] towards the unit vector `u`.
  [[nodiscard]] double distance(Vec2 u) const {
    if (is_round()) return round_distance(u);
    const Vec2 d = b - a;
    const double across = cross(u, d);
    if (across == 0.0) return kNever;
    const double place = cross(a, u) / across;
    const double t = cross(a, d) / across;
    return place >= 0.0 && place <= 1.0 && t >= 0.0 ? t : kNever;
  }
  [[nodiscard]] double round_distance(Vec2 u) const {
    const double middle = dot(u, a);
    const double rest = middle * middle - dot(a, a) + radius * radius;
    if (rest < 0.0) return kNever;
    const double near = middle - std::sqrt(rest);
    const double far = middle + std::sqrt(rest);
    return near >= 0.0 ? near : far >= 0.0 ? far : kNever;
  }
  /// Returns false if the sensor is on the side of the solid.
  [[nodiscard]] bool from_outside() const { return is_round() ? norm(a) >= radius : cross(b - a, a) >= 0.0; }
  /// Returns the angle between the normal and the ray towards `u` that meets it at `range` [rad].
  [[nodiscard]] double incidence(Vec2 u, double range) const {
    const Vec2 normal = is_round() ? range * u - a : Vec2{a.y - b.y, b.x - a.x};
    return std::atan2(std::fabs(cross(u, normal)), std::fabs(dot(u, normal)));
  }
  /// Returns true if both are straight and their directions differ by at most 1 deg.
  [[nodiscard]] bool in_line(const UprightFace& other) const {
    const Vec2 d = b - a;
    const Vec2 e = other.b - other.a;
    return !is_round() && !other.is_round() &&
           std::fabs(cross(d, e)) <= std::sin(kDegree) * norm(d) * norm(e);
  }
  /// Returns the distance of a point from a straight one [m].
  [[nodiscard]] double away_from(Vec2 point) const {
    const Vec2 d = b - a;
    const double place = std::clamp(dot(point - a, d) / dot(d, d), 0.0, 1.0);
    return norm(a + place * d - point);
  }
};

/// Calls visit(point) where two faces cross, seen from above.
template <class Visit>
void for_crossings(const UprightFace& one, const UprightFace& other, const Visit& visit) {
  if (one.is_round() && !other.is_round()) return for_crossings(other, one, visit);
  const auto on_one = [&](double place) {
    if (place >= 0.0 && place <= 1.0) visit(one.a + place * (one.b - one.a));
  };
  const Vec2 w = other.a - one.a;
  if (one.is_round()) {
    const double apart = norm(w);
    const double cosine =
        (one.radius * one.radius + apart * apart - other.radius * other.radius) / (2.0 * one.radius * apart);
    if (!(std::fabs(cosine) <= 1.0)) return;
    for (const double off : {-std::acos(cosine), std::acos(cosine)})
      visit(one.a + one.radius * direction(std::atan2(w.y, w.x) + off));
    return;
  }
  const Vec2 d = one.b - one.a;
  if (!other.is_round()) {
    const double there = cross(w, d) / cross(d, other.b - other.a);
    if (there >= 0.0 && there <= 1.0) on_one(cross(w, other.b - other.a) / cross(d, other.b - other.a));
    return;
  }
  const double middle = dot(w, d) / dot(d, d);
  const double rest = middle * middle - (dot(w, w) - other.radius * other.radius) / dot(d, d);
  if (rest < 0.0) return;
  on_one(middle - std::sqrt(rest));
  on_one(middle + std::sqrt(rest));
}

}  // namespace orca::sim::test
