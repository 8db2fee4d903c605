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

  void straight() {
    const Vec2 way = from_.beam.sensor.position() - to_.beam.sensor.position();
    const double length = norm(way);
    if (length <= kInBody) return;
    if (!in_window(length) || to_.strength(way) * from_.strength(-1.0 * way) < kThreshold) return;
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
Circle around(Vec2 tip, Vec2 axis, double half_angle, double reach) {
  if (half_angle > 0.25 * std::numbers::pi) return {tip, reach + kInBody};
  const double radius = 0.5 * reach / std::cos(half_angle);
  return {tip + radius * axis, radius + kInBody};
}

}  // namespace

SonarAir::Cone::Cone(const Beam& from, double reach)
    : beam(from),
      axis(direction(from.sensor.yaw)),
      tan_lobe(std::tan(from.half_lobe)),
      around(detail::around(from.sensor.position(), axis, from.half_lobe, reach)) {}

double SonarAir::Cone::strength(Vec2 towards) const {
  const double along = dot(axis, towards);
  const double across = std::fabs(cross(axis, towards));
  if (across > along * tan_lobe) return 0.0;
  const double share = std::atan2(across, along) / beam.half_lobe;
  return std::exp(-share * share);
}

std::uint64_t SonarAir::send(TimePoint time, const Beam& beam, double reach) {
  chirps_.push_back({sent_, time, Cone(beam, reach)});
  return sent_++;
}

void SonarAir::settle(TimePoint now) {
  std::erase_if(chirps_, [&](const Chirp& chirp) { return chirp.time < now - kFadesAfter; });
}

std::optional<double> SonarAir::first_heard(const Caster& caster, const Beam& listener, std::uint64_t own,
                                            TimePoint since, const Echo& echo) const {
  const Cone ear(listener, echo.reach);
  std::optional<double> nearest = echo.range;
  for (const Chirp& chirp : chirps_) {
    const bool foreign = chirp.number != own && chirp.time <= since && chirp.time >= since - kFadesAfter;
    if (!foreign || !may_meet(chirp.cone.around, ear.around)) continue;
    Ways ways(caster, chirp.cone, ear, kSoundSpeed * to_seconds(since - chirp.time), nearest);
    ways.straight();
    for (const Surface& surface : echo.surfaces) ways.off(surface);
    nearest = ways.nearest();
  }
  return nearest;
}

}  // namespace orca::sim::detail
