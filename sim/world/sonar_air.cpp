// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sonar_air.hpp"

#include <algorithm>

namespace orca::sim::detail {
namespace {

constexpr double kSoundSpeed = 343.0;  // [m/s] In air of 20 degrees Celsius.
// Older sound is too weak to be heard, or beyond the range of any ring.
constexpr Duration kFadesAfter = std::chrono::milliseconds{40};
// [m] A transducer sits in its robot's body, whose boundary is what a ray meets.
constexpr double kInBody = 0.1;

// Strength of a transducer in a direction that is off its axis, on one way: squared, it is what its own echo
// has from there (sonar_echo.cpp).
double one_way(const Beam& beam, Vec2 towards) {
  const Vec2 axis = direction(beam.sensor.yaw);
  const double off = std::atan2(std::fabs(cross(axis, towards)), dot(axis, towards));
  if (off > beam.half_lobe) return 0.0;
  const double share = off / beam.half_lobe;
  return std::exp(-share * share);
}

// A circle that holds the cone.
Circle around(const Beam& beam) {
  const double half = 0.5 * beam.max_range;
  return {beam.sensor.position() + half * direction(beam.sensor.yaw),
          half * std::fmax(1.0, 2.0 * std::sin(beam.half_lobe)) + kInBody};
}

Vec2 mirrored(Vec2 p, const Segment& mirror) {
  const Vec2 along = mirror.b - mirror.a;
  const Vec2 foot = mirror.a + dot(p - mirror.a, along) / dot(along, along) * along;
  return 2.0 * foot - p;
}

// Follows the ways from one transducer to another and keeps the shortest that arrives in the window.
class Ways {
 public:
  Ways(const Caster& caster, const Beam& from, const Beam& to, double head_start)
      : caster_(caster), from_(from), to_(to), head_start_(head_start) {}

  void straight() {
    const Vec2 way = from_.sensor.position() - to_.sensor.position();
    const double length = norm(way);
    if (length <= kInBody) return;
    const double strength = one_way(to_, way) * one_way(from_, -1.0 * way);
    if (!heard(length, strength)) return;
    if (caster_.cast(to_.ray((1.0 / length) * way)).range >= std::fmin(length - kInBody, to_.max_range))
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
    const Vec2 from = from_.sensor.position();
    const Vec2 to = to_.sensor.position();
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
    const Vec2 one = from_.sensor.position() - circle.center;
    const Vec2 other = to_.sensor.position() - circle.center;
    const Vec2 half = (1.0 / norm(one)) * one + (1.0 / norm(other)) * other;
    if (norm(half) > 0.0) off_point(circle.center + (circle.radius / norm(half)) * half, 1.0);
  }
  void off_point(Vec2 point, double strength) {
    const Vec2 from = point - from_.sensor.position();
    const Vec2 to = point - to_.sensor.position();
    const double length = norm(from) + norm(to);
    if (heard(length, strength * one_way(to_, to) * one_way(from_, from)) && sees(from_, from) &&
        sees(to_, to))
      keep(length);
  }
  [[nodiscard]] bool sees(const Beam& beam, Vec2 way) const {
    const double length = norm(way);
    return length <= beam.max_range && caster_.cast(beam.ray((1.0 / length) * way)).range >= length - kSeen;
  }
  [[nodiscard]] double taken_for(double length) const { return 0.5 * (length - head_start_); }
  [[nodiscard]] bool heard(double length, double strength) const {
    const double range = taken_for(length);
    return strength >= kThreshold && 0.5 * length <= to_.max_range && range >= to_.min_range;
  }
  void keep(double length) {
    const double range = taken_for(length);
    if (!nearest_ || range < *nearest_) nearest_ = range;
  }

  const Caster& caster_;
  const Beam& from_;
  const Beam& to_;
  double head_start_;  // [m] How far the sound had gone already when the listener sent its own.
  std::optional<double> nearest_;
};

bool may_meet(const Beam& one, const Beam& other) {
  const Circle a = around(one);
  const Circle b = around(other);
  return norm(a.center - b.center) <= a.radius + b.radius;
}

}  // namespace

std::uint64_t SonarAir::send(TimePoint time, const Beam& beam) {
  chirps_.push_back({sent_, time, beam});
  return sent_++;
}

void SonarAir::settle(TimePoint now) {
  std::erase_if(chirps_, [&](const Chirp& chirp) { return chirp.time < now - kFadesAfter; });
}

std::optional<double> SonarAir::stray(const Caster& caster, const Beam& listener, std::uint64_t own,
                                      TimePoint since, const std::vector<Surface>& surfaces) const {
  std::optional<double> nearest;
  for (const Chirp& chirp : chirps_) {
    const bool foreign = chirp.number != own && chirp.time <= since && chirp.time >= since - kFadesAfter;
    if (!foreign || !may_meet(chirp.beam, listener)) continue;
    Ways ways(caster, chirp.beam, listener, kSoundSpeed * to_seconds(since - chirp.time));
    ways.straight();
    for (const Surface& surface : surfaces) ways.off(surface);
    if (ways.nearest() && (!nearest || *ways.nearest() < *nearest)) nearest = ways.nearest();
  }
  return nearest;
}

}  // namespace orca::sim::detail
