// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sonar_air.hpp"

#include <algorithm>
#include <numbers>

namespace orca::sim::detail {
namespace {

constexpr double kSoundSpeed = 343.0;  // [m/s] In air of 20 degrees Celsius.
// Older sound is too weak to be heard, or beyond the range of any ring.
constexpr Duration kFadesAfter = std::chrono::milliseconds{40};
// [m] A transducer sits in its robot's body, whose boundary is what a ray meets.
constexpr double kInBody = 0.1;

Vec2 mirrored(Vec2 p, const Segment& mirror) {
  const Vec2 along = mirror.b - mirror.a;
  const Vec2 foot = mirror.a + dot(p - mirror.a, along) / dot(along, along) * along;
  return 2.0 * foot - p;
}

// Follows the ways from one transducer to another and keeps the shortest that arrives in the window.
class Ways {
 public:
  Ways(const Caster& caster, const SonarAir::Cone& from, const SonarAir::Cone& to, double head_start,
       std::optional<double> nearest)
      : caster_(caster), from_(from), to_(to), head_start_(head_start), nearest_(nearest) {}

  // False if all ways are too long or too short: longer than the straight one, shorter than both cones.
  [[nodiscard]] bool may_be_heard() const {
    const double shortest = norm(from_.beam.sensor.position() - to_.beam.sensor.position());
    const double longest = from_.reach + to_.reach + 2.0 * kInBody;
    return taken_for(longest) >= to_.beam.min_range && (!nearest_ || taken_for(shortest) < *nearest_);
  }

  void straight() {
    const Vec2 way = from_.beam.sensor.position() - to_.beam.sensor.position();
    const double length = norm(way);
    if (length <= kInBody) return;
    if (!to_.holds(way) || !from_.holds(-1.0 * way) || !in_window(length)) return;
    if (to_.strength(way) * from_.strength(-1.0 * way) < kThreshold) return;
    if (caster_.cast(to_.beam.ray((1.0 / length) * way)).range >=
        std::fmin(length - kInBody, to_.beam.max_range))
      keep(length);
  }

  void off(const Surface& surface) {
    if (const auto* circle = std::get_if<Circle>(&surface)) off_circle(*circle);
    if (const auto* edge = std::get_if<Segment>(&surface)) {
      off_mirror(*edge);
      off_point(edge->a, kEdgeStrength);
      off_point(edge->b, kEdgeStrength);
    }
  }

  [[nodiscard]] std::optional<double> nearest() const { return nearest_; }

 private:
  // Sound comes off a wall as from the sender's image behind it.
  void off_mirror(const Segment& wall) {
    const Vec2 from = from_.beam.sensor.position();
    const Vec2 to = to_.beam.sensor.position();
    const Vec2 along = wall.b - wall.a;
    const double side = cross(along, from - wall.a);
    const double other = cross(along, to - wall.a);
    if (side * other <= 0.0) return;
    const Vec2 hit = to + other / (side + other) * (mirrored(from, wall) - to);
    const double share = dot(hit - wall.a, along) / dot(along, along);
    if (share > 0.0 && share < 1.0) off_point(hit, 1.0);
  }
  // Near enough where the two directions to its centre meet halfway.
  void off_circle(const Circle& circle) {
    const Vec2 one = from_.beam.sensor.position() - circle.center;
    const Vec2 other = to_.beam.sensor.position() - circle.center;
    const Vec2 half = (1.0 / norm(one)) * one + (1.0 / norm(other)) * other;
    if (norm(half) > 0.0) off_point(circle.center + (circle.radius / norm(half)) * half, 1.0);
  }
  void off_point(Vec2 point, double strength) {
    const Vec2 from = point - from_.beam.sensor.position();
    const Vec2 to = point - to_.beam.sensor.position();
    if (!to_.holds(to) || !from_.holds(from)) return;
    const double length = norm(from) + norm(to);
    if (!in_window(length) || strength * to_.strength(to) * from_.strength(from) < kThreshold) return;
    if (sees(from_.beam, from) && sees(to_.beam, to)) keep(length);
  }
  [[nodiscard]] bool sees(const Beam& beam, Vec2 way) const {
    const double length = norm(way);
    return length <= beam.max_range && caster_.cast(beam.ray((1.0 / length) * way)).range >= length - kSeen;
  }
  [[nodiscard]] double taken_for(double length) const { return 0.5 * (length - head_start_); }
  [[nodiscard]] bool in_window(double length) const {
    const double range = taken_for(length);
    return 0.5 * length <= to_.beam.max_range && range >= to_.beam.min_range &&
           (!nearest_ || range < *nearest_);
  }
  void keep(double length) { nearest_ = taken_for(length); }

  const Caster& caster_;
  const SonarAir::Cone& from_;
  const SonarAir::Cone& to_;
  double head_start_;  // [m] How far the sound had gone already when the listener sent its own.
  std::optional<double> nearest_;
};

bool may_meet(const Circle& one, const Circle& other) {
  const Vec2 apart = one.center - other.center;
  const double reach = one.radius + other.radius;
  return dot(apart, apart) <= reach * reach;
}

// The smallest circle around the sector, if that is narrow.
Circle around(const SonarAir::Cone& cone) {
  const Vec2 tip = cone.beam.sensor.position();
  if (cone.beam.half_lobe > 0.25 * std::numbers::pi) return {tip, cone.reach + kInBody};
  const double radius = 0.5 * cone.reach / std::cos(cone.beam.half_lobe);
  return {tip + radius * cone.axis, radius + kInBody};
}

}  // namespace

SonarAir::Cone::Cone(const Beam& from, double goes)
    : beam(from), reach(goes), axis(direction(from.sensor.yaw)), tan_lobe(std::tan(from.half_lobe)) {}

double SonarAir::Cone::strength(Vec2 towards) const {
  const double share = std::atan2(std::fabs(cross(axis, towards)), dot(axis, towards)) / beam.half_lobe;
  return std::exp(-share * share);
}

std::uint64_t SonarAir::send(TimePoint time, const Beam& beam, double reach) {
  cones_.emplace_back(beam, reach);
  chirps_.push_back({time, around(cones_.back())});
  return first_ + chirps_.size() - 1;
}

void SonarAir::settle(TimePoint now) {
  const auto is_heard = [&](const Chirp& chirp) { return chirp.time >= now - kFadesAfter; };
  const auto gone = std::ranges::find_if(chirps_, is_heard) - chirps_.begin();
  chirps_.erase(chirps_.begin(), chirps_.begin() + gone);
  cones_.erase(cones_.begin(), cones_.begin() + gone);
  first_ += static_cast<std::uint64_t>(gone);
}

std::optional<double> SonarAir::first_heard(const Caster& caster, const Beam& listener, std::uint64_t own,
                                            TimePoint since, const Echo& echo) const {
  const Cone ear(listener, echo.reach);
  const Circle near = around(ear);
  std::optional<double> nearest = echo.range;
  for (std::size_t i = 0; i < chirps_.size(); ++i) {
    const Duration age = since - chirps_[i].time;
    if (age < Duration{} || age > kFadesAfter || first_ + i == own || !may_meet(chirps_[i].around, near))
      continue;
    Ways ways(caster, cones_[i], ear, kSoundSpeed * to_seconds(age), nearest);
    if (!ways.may_be_heard()) continue;
    ways.straight();
    for (const Surface& surface : echo.surfaces) ways.off(surface);
    nearest = ways.nearest();
  }
  return nearest;
}

}  // namespace orca::sim::detail
